// SPDX-License-Identifier: Apache-2.0
#pragma once

// Which bodies have changed since somebody asked. Nothing is kept until the first question.

#include <stoss/engine/types.hpp>

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace stoss::engine {

class ChangeLog {
 public:
  /// A body that comes and goes between two questions leaves no trace.
  void note(Id id, ChangeKind kind) {
    if (!tracking_) return;
    const auto [entry, is_new] = change_of_.try_emplace(id, kind);
    if (is_new) {
      changed_.push_back(id);
    } else if (kind == ChangeKind::Removed) {
      if (entry->second != ChangeKind::Spawned) {
        entry->second = kind;
        return;
      }
      change_of_.erase(entry);
      std::erase(changed_, id);
    }
  }

  /// What changed since the last call, in the order of ids. `ids()` names all bodies: the answer to
  /// the first question.
  template <class Ids>
  std::vector<Change> drain(const Ids& ids) {
    std::vector<Change> changes;
    if (!tracking_) {
      tracking_ = true;
      for (const Id id : ids()) changes.push_back({id, ChangeKind::Spawned});
      return changes;
    }
    std::sort(changed_.begin(), changed_.end());
    changes.reserve(changed_.size());
    for (const Id id : changed_) changes.push_back({id, change_of_.at(id)});
    changed_.clear();
    change_of_.clear();
    return changes;
  }

 private:
  bool tracking_ = false;
  std::vector<Id> changed_;
  std::unordered_map<Id, ChangeKind> change_of_;
};

}  // namespace stoss::engine
