#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Proves that check_tree.py fires on every kind of violation, and on nothing else.

Each case plants one violation in a clean tree in a temporary folder.
"""

import pathlib
import tempfile
import unittest

import check_tree
import source

CPP = "// SPDX-License-Identifier: Apache-2.0\n"
HEADER = CPP + "#pragma once\n"
HASH = "# SPDX-License-Identifier: Apache-2.0\n"

# Keeps every rule, and comes close to several.
CLEAN = {
    "CMakeLists.txt": HASH + "add_subdirectory(engine)  # never with -ffast-math\n",
    "engine/CMakeLists.txt": HASH + "# knows nothing of CycloneDDS\nadd_library(e src/world.cpp)\n",
    "engine/include/stoss/engine/world.hpp": HEADER + "#include <vector>\n#include <Eigen/Core>\n",
    "engine/include/stoss/engine/double_word.hpp": HEADER + "// Source: a\n// Accuracy: b\n",
    "engine/src/world.cpp": CPP + '#include <stoss/engine/world.hpp>\n#include "queue.hpp"\n'
                                  '// #include <chrono>\nconst char* s = "std::hash<int>";\n',
    "engine/src/queue.hpp": HEADER + "inline int f(int x) { return x * 1'000; }\n",
    "engine/src/contact_time/pair.hpp": HEADER + "// Source: a\n// Accuracy: b\n",
    "engine/wide/src/wide.cpp": CPP + "#include <quadmath.h>\n#include <qd/dd_real.h>\n"
                                      "#include <stoss/engine/world.hpp>\n",
    "idl/include/stoss/dds/writer.hpp": HEADER + "#include <dds/dds.h>\n",
    "idl/include/stoss/idl/topics.hpp": HEADER + "#include <stoss.h>\n#include <scene.pb.h>\n"
                                                 "#include <google/protobuf/message.h>\n",
    "idl/translate/include/stoss/translate/scene.hpp":
        HEADER + "#include <stoss/engine/world.hpp>\n#include <stoss/idl/topics.hpp>\n",
    "idl/stoss.idl": CPP + "module stoss {};\n",
    "service/src/main.cpp": CPP + "#include <spdlog/spdlog.h>\n#include <CLI/CLI.hpp>\n#include "
                                  "<stoss/translate/scene.hpp>\n#include <sys/socket.h>\n",
    "clients/src/main.cpp": CPP + "#include <stoss/dds/writer.hpp>\n#include <ncurses.h>\n",
    "tests/engine/queue_test.cpp": CPP + '#include "queue.hpp"\n#include <gtest/gtest.h>\n'
                                         "#include <dds/dds.h>\n",
    "deploy/run": "#!/bin/sh\n" + HASH + "exec true\n",
    "README.md": "No banned words.\n",
}

LONG_BODY = "".join(f"  a = {i};\n" for i in range(70))

# (what is planted, the file, its text, a part of the one message expected)
PLANTED = [
    ("engine knows Eigen alone", "engine/src/a.cpp", CPP + "#include <spdlog/spdlog.h>\n",
     "engine knows no such library"),
    ("engine has no POSIX", "engine/src/a.cpp", CPP + "#include <unistd.h>\n",
     "engine knows no such library"),
    ("engine has no clocks", "engine/src/a.cpp", CPP + "#include <chrono>\n", "<chrono>"),
    ("engine has no threads", "engine/src/a.cpp", CPP + "#include <thread>\n", "<thread>"),
    ("engine has no locks", "engine/src/a.cpp", CPP + "#include <mutex>\n", "<mutex>"),
    ("engine has no streams", "engine/src/a.cpp", CPP + "#include <iostream>\n", "<iostream>"),
    ("engine has no files", "engine/src/a.cpp", CPP + "#include <fstream>\n", "<fstream>"),
    ("engine has no dice", "engine/src/a.cpp", CPP + "#include <random>\n", "<random>"),
    ("engine has no dates", "engine/src/a.cpp", CPP + "#include <ctime>\n", "<ctime>"),
    ("wide arithmetic stays out of engine", "engine/src/a.cpp", CPP + "#include <quadmath.h>\n",
     "engine knows no such library"),
    ("engine knows no contract", "engine/src/a.cpp", CPP + "#include <stoss/idl/topics.hpp>\n",
     "engine may not know idl"),
    ("engine knows no generated code", "engine/src/a.cpp", CPP + "#include <scene.pb.h>\n",
     "engine may not know idl"),
    ("idl knows no engine", "idl/src/a.cpp", CPP + "#include <stoss/engine/world.hpp>\n",
     "idl may not know engine"),
    ("idl does not log", "idl/src/a.cpp", CPP + "#include <spdlog/spdlog.h>\n",
     "idl knows no such library"),
    ("translate knows no service", "idl/translate/src/a.cpp",
     CPP + "#include <stoss/service/run.hpp>\n", "translate may not know service"),
    ("service sees public headers only", "service/src/a.cpp",
     CPP + '#include "../../engine/src/queue.hpp"\n', "a private header of engine"),
    ("service knows no client", "service/src/a.cpp", CPP + "#include <stoss/client/connect.hpp>\n",
     "service may not know clients"),
    ("clients know no service", "clients/src/a.cpp", CPP + "#include <stoss/service/run.hpp>\n",
     "clients may not know service"),
    ("clients do not log", "clients/src/a.cpp", CPP + "#include <spdlog/spdlog.h>\n",
     "clients knows no such library"),
    ("nobody knows tests", "service/src/a.cpp", CPP + '#include "../../tests/engine/oracle.hpp"\n',
     "service knows no such library"),
    ("raw DDS header in service", "service/src/a.cpp", CPP + "#include <dds/dds.h>\n",
     "service knows no such library"),
    ("raw DDS call in clients", "clients/src/a.cpp", CPP + "int x = dds_take(1);\n", "raw DDS"),
    ("raw DDS handle in service", "service/src/a.cpp", CPP + "dds_entity_t x;\n", "raw DDS"),
    ("engine's build links DDS", "engine/CMakeLists.txt",
     HASH + "target_link_libraries(e PUBLIC CycloneDDS::ddsc)\n", "engine may not link CycloneDDS"),
    ("clients' build links service", "clients/CMakeLists.txt",
     HASH + "target_link_libraries(c PUBLIC stoss::service_core)\n", "clients may not link"),
    ("no SPDX line", "idl/src/a.cpp", "int x;\n", "SPDX-License-Identifier"),
    ("no SPDX line after #!", "deploy/a", "#!/bin/sh\nexec true\n", "SPDX-License-Identifier"),
    ("no SPDX line in a contract", "idl/a.proto", 'syntax = "proto3";\n', "SPDX"),
    ("no #pragma once", "idl/include/stoss/idl/a.hpp", CPP + "int f();\n", "#pragma once"),
    ("numerics without a source", "engine/src/contact_time/a.hpp", HEADER + "// Accuracy: b\n",
     "'Source:'"),
    ("numerics without accuracy", "engine/src/contact_law/a.hpp", HEADER + "// Source: a\n",
     "'Accuracy:'"),
    ("a line too long", "service/src/a.cpp", CPP + f"// {98 * 'x'}\n", "101 columns"),
    ("blanks at the end", "service/src/a.cpp", CPP + "int x; \n", "blanks at the end"),
    ("a function too long", "service/src/a.cpp", CPP + f"void f(int a) {{\n{LONG_BODY}}}\n",
     "a function of 72 lines"),
    ("a member too long", "service/src/a.cpp",
     CPP + f"namespace n {{\nclass C : B<D> {{\n  void f(int a) const {{\n{LONG_BODY}}}\n}};\n}}\n",
     "a function of 72 lines"),
    ("a constructor too long", "service/src/a.cpp",
     CPP + f"template <class T>\nC<T>::C(int x)\n    : a_{{x}}, b_(x) {{\n{LONG_BODY}}}\n",
     "a function of 74 lines"),
    ("a promise", "clients/a.md", "TODO: write this.\n", "do it now"),
    ("a promise in code", "service/src/a.cpp", CPP + "// FIXME later\n", "do it now"),
    ("a path of one machine", "deploy/a", "#!/bin/sh\n" + HASH + "cd /work/main\n",
     "a path of one machine"),
    ("a number of an issue", "clients/a.md", "See issue 12.\n", "numbers of issues"),
    ("inexact arithmetic", "service/CMakeLists.txt", HASH + "add_compile_options(-ffast-math)\n",
     "IEEE arithmetic"),
    ("endl", "clients/src/a.cpp", CPP + "void f() { std::cout << std::endl; }\n", "'\\n'"),
    ("a clock that jumps", "service/src/a.cpp",
     CPP + "using C = std::chrono::high_resolution_clock;\n", "steady_clock"),
    ("an unseeded test", "tests/engine/a_test.cpp", CPP + "std::random_device r;\n", "fixed seed"),
    ("a namespace opened in a header", "service/src/a.hpp", HEADER + "using namespace std;\n",
     "name what is used"),
    ("std::hash in engine", "engine/src/a.cpp", CPP + "std::hash<int> h;\n", "canonical bytes"),
    ("libm in engine", "engine/src/a.cpp", CPP + "double f(double x) { return std::sin(x); }\n",
     "differs between libm builds"),
    ("a heap of the library in engine", "engine/src/a.cpp",
     CPP + "void f() { std::push_heap(a, b); }\n", "order of equal keys"),
    ("a walk over a hash table", "engine/src/a.cpp",
     CPP + "std::unordered_map<int, double> slots_;\nvoid f() { for (auto& s : slots_) g(s); }\n",
     "walks the hash table slots_"),
    ("environment in engine", "engine/src/a.cpp", CPP + 'auto x = getenv("A");\n', "WorldOptions"),
]

# Violations that two checks see.
SEEN_TWICE = {"raw DDS header in service"}


class CheckTree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="stoss-architecture-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for path, text in CLEAN.items():
            self.plant(path, text)

    def plant(self, path, text):
        target = self.root / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def test_clean_tree_has_no_violation(self):
        self.assertEqual(check_tree.violations(self.root), [])

    def test_each_planted_violation_is_found(self):
        for what, path, text, expected in PLANTED:
            with self.subTest(what):
                before = CLEAN.get(path)
                self.plant(path, text)
                found = check_tree.violations(self.root)
                if before is None:
                    (self.root / path).unlink()
                else:
                    self.plant(path, before)
                self.assertEqual(len(found), 2 if what in SEEN_TWICE else 1, found)
                self.assertIn(expected, found[0])
                self.assertTrue(found[0].startswith(f"{path}:"), found[0])

    def test_included_tests_are_refused_by_name(self):
        self.plant("tests/engine/oracle.hpp", HEADER)
        self.plant("service/src/a.cpp", CPP + '#include "../../tests/engine/oracle.hpp"\n')
        found = check_tree.violations(self.root)
        self.assertEqual(len(found), 1, found)
        self.assertIn("nobody knows tests", found[0])

    def test_every_check_is_planted(self):
        for check in check_tree.CHECKS:
            with self.subTest(check.__name__):
                fired = False
                for _, path, text, _ in PLANTED:
                    self.plant(path, text)
                    tree = check_tree.Tree(self.root)
                    fired = fired or any(True for _ in check(tree))
                    if path in CLEAN:
                        self.plant(path, CLEAN[path])
                    else:
                        (self.root / path).unlink()
                self.assertTrue(fired)


class Functions(unittest.TestCase):
    def lengths(self, text):
        return [last - first + 1 for first, last in source.functions(source.code_only(text))]

    def test_counts_functions_not_scopes_or_initialisers(self):
        self.assertEqual(self.lengths("namespace a {\nint x = {1};\nint f() {\n  return 1;\n}\n}"),
                         [3])
        self.assertEqual(self.lengths("struct A {\n  int x{0};\n  A() : x{1} {}\n};\n"), [1])
        self.assertEqual(self.lengths("enum class E : int {\n  A,\n  B\n};\n"), [])

    def test_lambdas_and_blocks_belong_to_their_function(self):
        self.assertEqual(self.lengths("void f() {\n  auto g = [](int x) {\n    if (x) {\n    }\n"
                                      "  };\n}\n"), [6])

    def test_braces_in_comments_and_literals_do_not_count(self):
        self.assertEqual(self.lengths("void f() {\n  // {\n  g('{', \"{\", R\"({)\");\n}\n"), [4])

    def test_templates_and_trailing_return_types(self):
        self.assertEqual(self.lengths("template <class T>\nauto f(T x) -> decltype(x) {\n"
                                      "  return x;\n}\n"), [4])


if __name__ == "__main__":
    unittest.main()
