// SPDX-License-Identifier: Apache-2.0
// The table of slots against a plain map.
#include "slot_table.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace stoss::engine {
namespace {

class Table {
 public:
  void insert(Id id) {
    Slot slot = static_cast<Slot>(id_of_.size());
    if (!free_.empty()) {
      slot = free_.back();
      free_.pop_back();
    } else {
      id_of_.push_back(kNoId);
    }
    id_of_[static_cast<std::size_t>(slot)] = id;
    table_.insert(id, slot, ids());
    reference_[id] = slot;
  }
  void erase(Id id) {
    table_.erase(id, ids());
    const Slot slot = reference_.at(id);
    id_of_[static_cast<std::size_t>(slot)] = kNoId;
    free_.push_back(slot);
    reference_.erase(id);
  }
  bool contains(Id id) const { return reference_.contains(id); }
  void expect_same(Id id) const {
    const auto found = reference_.find(id);
    EXPECT_EQ(table_.find(id, ids()), found == reference_.end() ? SlotTable::kNone : found->second)
        << id;
    EXPECT_EQ(table_.size(), reference_.size());
  }
  void expect_all_same() const {
    for (const auto& [id, slot] : reference_) EXPECT_EQ(table_.find(id, ids()), slot) << id;
  }

 private:
  struct Ids {
    const std::vector<Id>& of;
    Id operator()(Slot slot) const { return of[static_cast<std::size_t>(slot)]; }
  };
  Ids ids() const { return {id_of_}; }

  SlotTable table_;
  std::vector<Id> id_of_;
  std::vector<Slot> free_;
  std::map<Id, Slot> reference_;
};

TEST(SlotTable, AgreesWithAMapUnderRandomWork) {
  test::Random random(test::seed_of_run());
  for (const std::uint64_t range : {8U, 100U, 100'000U}) {
    for (const std::uint64_t stride : {Id{1}, Id{4096}, Id{1} << 44}) {
      Table table;
      for (int i = 0; i < 4000; ++i) {
        const Id id = stride * (1 + random.below(range));
        table.expect_same(id);
        if (table.contains(id)) {
          table.erase(id);
        } else {
          table.insert(id);
        }
        table.expect_same(id);
      }
      table.expect_all_same();
    }
  }
}

TEST(SlotTable, MakesRoomForAllAtOnce) {
  SlotTable table;
  const auto id_of = [](Slot slot) { return Id{7} * static_cast<Id>(slot); };
  EXPECT_EQ(table.find(7, id_of), SlotTable::kNone);
  table.reserve(10'000, id_of);
  for (Slot slot = 1; slot <= 10'000; ++slot) table.insert(id_of(slot), slot, id_of);
  for (Slot slot = 1; slot <= 10'000; ++slot) EXPECT_EQ(table.find(id_of(slot), id_of), slot);
  EXPECT_EQ(table.find(8, id_of), SlotTable::kNone);
  EXPECT_FALSE(table.empty());
}

}  // namespace
}  // namespace stoss::engine
