// SPDX-License-Identifier: Apache-2.0
#pragma once

// Options that stand beside those of Google Benchmark.

#include <algorithm>
#include <cstring>

namespace stoss::bench {

/// Takes an option of the program's own out of the arguments. Returns whether it was there.
inline bool take(int& argc, char** argv, const char* option) {
  char** const end = argv + argc;
  char** const found =
      std::find_if(argv + 1, end, [&](const char* word) { return std::strcmp(word, option) == 0; });
  if (found == end) return false;
  std::move(found + 1, end, found);
  --argc;
  return true;
}

}  // namespace stoss::bench
