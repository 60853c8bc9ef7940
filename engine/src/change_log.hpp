// SPDX-License-Identifier: Apache-2.0
#pragma once

// Which bodies have changed since somebody asked. Nothing is kept until the first question. Noting
// costs a look into a table, and no memory once the table has grown to what changes between two
// questions.

#include "slot_table.hpp"

#include <stoss/engine/types.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace stoss::engine {

class ChangeLog {
  auto id_of() const {
    return [this](std::int32_t place) { return changed_[static_cast<std::size_t>(place)].id; };
  }

 public:
  /// A body that comes and goes between two questions leaves no trace.
  void note(Id id, ChangeKind kind) {
    if (!tracking_) return;
    const std::int32_t known = places_.find(id, id_of());
    if (known < 0) {
      changed_.push_back({id, kind});
      places_.insert(id, static_cast<std::int32_t>(changed_.size() - 1), id_of());
    } else if (kind == ChangeKind::Removed) {
      Change& change = changed_[static_cast<std::size_t>(known)];
      if (std::exchange(change.kind, kind) != ChangeKind::Spawned) return;
      places_.erase(id, id_of());
      change.id = kNoId;
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
    changes.reserve(changed_.size());
    for (const Change& change : changed_) {
      if (change.id == kNoId) continue;
      changes.push_back(change);
      places_.erase(change.id, id_of());
    }
    changed_.clear();
    std::sort(changes.begin(), changes.end(), [](const Change& x, const Change& y) {
      return x.id < y.id;
    });
    return changes;
  }

 private:
  bool tracking_ = false;
  std::vector<Change> changed_;  ///< kNoId: no trace
  SlotTable places_;             ///< of ids in changed_
};

}  // namespace stoss::engine
