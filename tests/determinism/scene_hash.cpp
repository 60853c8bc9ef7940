// SPDX-License-Identifier: Apache-2.0
// scene_hash TABLE SCENES: runs every scene of the table and prints the table anew.
//
// With STOSS_WHOLE_ENGINE defined this is a program of one translation unit, so that every inline
// function in it is of the build that is under test.

#include "determinism/table.hpp"

#include <cstdio>
#include <exception>
#include <string>

#ifdef STOSS_WHOLE_ENGINE
#include "world_core.hpp"

// Left out: a long double is not the same number format everywhere.
namespace stoss::engine {
template <>
std::unique_ptr<WorldCore> make_plain_core<long double>(const WorldOptions&) {
  return nullptr;
}
template <>
std::unique_ptr<WorldCore> make_effects_core<long double>(const WorldOptions&) {
  return nullptr;
}
}  // namespace stoss::engine

// NOLINTBEGIN(bugprone-suspicious-include)
#include "broad_phase/aabb_tree.cpp"
#include "broad_phase/box_grid.cpp"
#include "broad_phase/cell_side.cpp"
#include "broad_phase/cell_store.cpp"
#include "broad_phase/disk_cells.cpp"
#include "broad_phase/list_pool.cpp"
#include "broad_phase/neighbours.cpp"
#include "effects.cpp"
#include "features.cpp"
#include "make_core.cpp"
#include "sight.cpp"
#include "world.cpp"
#include "world_double.cpp"
#include "world_double_effects.cpp"
#include "world_float.cpp"
#include "world_float_effects.cpp"
// NOLINTEND(bugprone-suspicious-include)
#endif

int main(int argc, char** argv) {
  using namespace stoss::determinism;
  if (argc != 3) {
    std::fputs("usage: scene_hash TABLE SCENES > NEW_TABLE\n", stderr);
    return 2;
  }
  try {
    std::string separator = "[\n";
    for (Row row : read_table(argv[1])) {
      const Bodies bodies = read_scene(std::string(argv[2]) + "/" + row.scene + ".json");
      for (const auto& [name, arithmetic] : kPinned) {
        row.digests[name] = run_scene(bodies, row.until, {.arithmetic = arithmetic});
      }
      std::printf("%s%s", separator.c_str(), to_line(row).c_str());
      separator = ",\n";
    }
    std::printf("\n]\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene_hash: %s\n", error.what());
    return 1;
  }
  return 0;
}
