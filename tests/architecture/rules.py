# SPDX-License-Identifier: Apache-2.0
"""Who may know whom, which words are banned and what stands instead: the data of check_tree.py."""

import re

# Rooms by path prefix; the longest that fits wins.
ROOMS = {
    "engine/": "engine",
    "engine/wide/": "wide",
    "idl/": "idl",
    "idl/translate/": "translate",
    "service/": "service",
    "clients/": "clients",
    "tests/": "tests",
}

# The room behind <stoss/NAME/...>, for headers that no include folder holds (yet).
ROOM_OF_PUBLIC_FOLDER = {
    "engine": "engine",
    "wide": "wide",
    "dds": "idl",
    "idl": "idl",
    "translate": "translate",
    "service": "service",
    "client": "clients",
}

# Headers that the build generates from idl's contracts.
GENERATED = re.compile(r"^(stoss\.h|\w+\.pb\.h)$")

POSIX = r"[a-z_]+\.h|(sys|net|netinet|arpa|linux)/[\w/]+\.h"

# Room -> rooms that it may include besides itself, and outside headers (a full match) that it may
# include besides the standard library.
MAY_KNOW = {
    "engine": (set(), r"Eigen/\w+"),
    "wide": ({"engine"}, r"Eigen/\w+|quadmath\.h|qd/\w+\.h|boost/multiprecision/\w+\.hpp"),
    "idl": (set(), rf"dds/[\w/]+\.h|google/protobuf/[\w/.]+\.h|{POSIX}"),
    "translate": ({"engine", "wide", "idl"}, r"google/protobuf/[\w/.]+\.h"),
    "service": ({"engine", "wide", "idl", "translate"},
                rf"spdlog/[\w/-]+\.h|CLI/\w+\.hpp|google/protobuf/[\w/.]+\.h|{POSIX}"),
    "clients": ({"engine", "wide", "idl", "translate"},
                r"CLI/\w+\.hpp|google/protobuf/[\w/.]+\.h|nlohmann/\w+\.hpp|pybind11/\w+\.h|"
                + POSIX),
    "tests": ({"engine", "wide", "idl", "translate", "service", "clients"}, r".*"),
}

# Private headers (those outside another room's include/) that a room may include: tests look inside
# everything; wide compiles the engine's own templates for wider numbers.
MAY_SEE_PRIVATE = {"tests": {"engine", "wide", "idl", "translate", "service", "clients"},
                   "wide": {"engine"}}

# Raw DDS handles live here and nowhere else. Tests compare with raw DDS and play foreign peers.
RAW_DDS_FOLDERS = ("idl/include/stoss/dds/", "idl/src/", "tests/")
RAW_DDS_CALL = re.compile(r"\bdds_(?!sequence_)\w+\s*\(|\bdds_entity_t\b")

# The engine has no clocks, threads, streams or dice.
ENGINE_BANNED_HEADERS = {
    **dict.fromkeys(("chrono", "ctime", "time.h"),
                    "simulated time is an Instant; wall clocks belong to service"),
    **dict.fromkeys(("thread", "mutex", "shared_mutex", "condition_variable", "future", "semaphore",
                     "barrier", "latch", "stop_token"),
                    "a world belongs to one thread; threads belong to service"),
    **dict.fromkeys(("iostream", "fstream", "istream", "ostream", "sstream", "iomanip", "cstdio",
                     "stdio.h", "filesystem", "locale", "syncstream"),
                    "return values and Rejects; input and output belong to service and clients"),
    **dict.fromkeys(("random",), "draw from a counter-based generator keyed by the scene's seed"),
}

# The rooms' CMakeLists.txt may not even name these.
CMAKE_BANNED = {
    "engine": r"\b(CycloneDDS|[Pp]rotobuf|spdlog|CLI11|Threads"
              r"|stoss::(idl|dds|translate|service\w*|client))\b",
    "idl": r"\b(spdlog|CLI11|stoss::(engine|service\w*|client))\b",
    "translate": r"\b(CycloneDDS::|spdlog|CLI11|stoss::(service\w*|client))",
    "service": r"\bstoss::client\b",
    "clients": r"\b(spdlog|stoss::service\w*)\b",
}

LIBM = (r"\bstd::(sinh?|cosh?|tanh?|asinh?|acosh?|atanh?|atan2|exp2?|expm1|log(10|2|1p)?|pow|cbrt"
        r"|hypot|erfc?|[lt]gamma)\s*\(")

# (rooms or None for all, kinds of file, pattern, what to do instead). Comments and strings of C++
# are blanked before the search but in the first group, which concerns words for people.
BANNED_ANYWHERE = [
    (re.compile(r"\b(TODO|FIXME|XXX|HACK)\b"), "do it now, or write the limitation into the docs"),
    (re.compile(r"/work/(main|shared|\.library)|/root/|/tmp/build-"),
     "a path of one machine; derive it from the source or build folder"),
    (re.compile(r"\bissue #?[0-9]"), "say what it is about; numbers of issues mean nothing here"),
]
BANNED_IN_CODE = [
    (None, ("cpp", "cmake", "script"),
     re.compile(r"-ffast-math|-Ofast|-funsafe-math-optimizations"),
     "exact results need IEEE arithmetic; leave the flag out"),
    (None, ("cpp",), re.compile(r"\bstd::endl\b"), r"'\n', and a flush only where one is needed"),
    (None, ("cpp",), re.compile(r"\bhigh_resolution_clock\b"), "std::chrono::steady_clock"),
    ({"engine", "wide", "tests"}, ("cpp",),
     re.compile(r"\brandom_device\b|\bstd::rand\b|\bsrand\s*\("),
     "a generator with a fixed seed that is printed and can be overridden"),
    (None, ("header",), re.compile(r"\busing\s+namespace\b"), "name what is used"),
    ({"engine"}, ("cpp",), re.compile(r"\bstd::hash\b"),
     "it differs between libraries; digest canonical bytes"),
    ({"engine"}, ("cpp",), re.compile(LIBM),
     "its last bit differs between libm builds; use + - * / sqrt and fma, or a routine of our own"),
    ({"engine"}, ("cpp",),
     re.compile(r"\bstd::(push_heap|pop_heap|make_heap)\b"),
     "the order of equal keys differs between libraries; use the event queue or std::stable_sort"),
    ({"engine"}, ("cpp",), re.compile(r"\bgetenv\s*\("), "pass it in WorldOptions"),
]

# Numerics say where their formula is from and how exact it is.
NUMERICS = re.compile(r"^engine/(.*/)?(contact_time|contact_law)/.*\.(hpp|cpp)$|/double_word\.hpp$")
NUMERICS_WORDS = ("Source:", "Accuracy:")

COLUMNS_MAX = 100
FUNCTION_LINES_MAX = 70
