// SPDX-License-Identifier: Apache-2.0
#pragma once

// Remembers which ids have been retired, so that none is used again. Runs of neighbouring ids are
// one entry, so a world that spawns and removes for months stays small.

#include <stoss/engine/types.hpp>

#include <map>

namespace stoss::engine {

class IdLedger {
 public:
  bool is_retired(Id id) const {
    auto run = runs_.upper_bound(id);
    if (run == runs_.begin()) return false;
    --run;
    return id <= run->second;
  }

  /// REQUIRES: not retired yet.
  void retire(Id id) {
    Id first = id;
    Id last = id;
    auto above = runs_.upper_bound(id);
    if (above != runs_.begin()) {
      const auto below = std::prev(above);
      if (below->second + 1 == id) {
        first = below->first;
        runs_.erase(below);
      }
    }
    if (above != runs_.end() && above->first == id + 1) {
      last = above->second;
      runs_.erase(above);
    }
    runs_.emplace(first, last);
  }

  /// First and last id of each run, in order.
  const std::map<Id, Id>& runs() const { return runs_; }
  void restore_run(Id first, Id last) { runs_.emplace_hint(runs_.end(), first, last); }

 private:
  std::map<Id, Id> runs_;
};

}  // namespace stoss::engine
