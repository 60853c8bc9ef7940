// SPDX-License-Identifier: Apache-2.0
// Retired ids against a plain set.
#include "id_ledger.hpp"

#include "support/random.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <limits>
#include <set>

namespace stoss::engine {
namespace {

TEST(IdLedger, AgreesWithASetUnderRandomWork) {
  test::Random random(test::seed_of_run());
  for (const std::uint64_t range : {10U, 100U, 100'000U}) {
    IdLedger ledger;
    std::set<Id> reference;
    for (int i = 0; i < 3000; ++i) {
      const Id id = 1 + random.below(range);
      EXPECT_EQ(ledger.is_retired(id), reference.contains(id));
      if (!reference.insert(id).second) continue;
      ledger.retire(id);
      EXPECT_TRUE(ledger.is_retired(id));
    }
    Id last = 0;
    std::size_t total = 0;
    for (const auto& [first, end] : ledger.runs()) {
      EXPECT_GT(first, last + (total == 0 ? 0 : 1));  // runs with gaps between them
      EXPECT_GE(end, first);
      total += end - first + 1;
      last = end;
    }
    EXPECT_EQ(total, reference.size());
  }
}

TEST(IdLedger, NeighbouringIdsAreOneRunInWhateverOrderTheyCome) {
  IdLedger ledger;
  for (const Id id : {7U, 3U, 5U, 4U, 6U}) ledger.retire(id);
  ASSERT_EQ(ledger.runs().size(), 1U);
  EXPECT_EQ(ledger.runs().begin()->first, 3U);
  EXPECT_EQ(ledger.runs().begin()->second, 7U);
  EXPECT_FALSE(ledger.is_retired(2));
  EXPECT_FALSE(ledger.is_retired(8));
}

TEST(IdLedger, HoldsTheEndsOfTheRange) {
  constexpr Id kLast = std::numeric_limits<Id>::max();
  IdLedger ledger;
  ledger.retire(kLast);
  ledger.retire(1);
  ledger.retire(kLast - 1);
  EXPECT_TRUE(ledger.is_retired(kLast));
  EXPECT_TRUE(ledger.is_retired(1));
  EXPECT_FALSE(ledger.is_retired(kLast - 2));
  EXPECT_EQ(ledger.runs().size(), 2U);
}

TEST(IdLedger, IsRestoredFromItsRuns) {
  IdLedger ledger;
  for (const Id id : {1U, 2U, 9U}) ledger.retire(id);
  IdLedger again;
  for (const auto& [first, last] : ledger.runs()) again.restore_run(first, last);
  EXPECT_EQ(again.runs(), ledger.runs());
  again.retire(3);
  EXPECT_EQ(again.runs().size(), 2U);
}

}  // namespace
}  // namespace stoss::engine
