// With 5 mm clearance and 1 mrad tracking error some pairs stay undecided at any effort. Their
// distance must be so near the clearance that little is lost.
#include <gtest/gtest.h>

#include "test/soundness/soundness.h"
#include "test/soundness/undecided.h"

namespace armloom::soundness {
namespace {

constexpr std::size_t kPairs = 300;

void expect_open_only_where_close(const CheckMethod& method, std::size_t open_max) {
  const OpenPairs found = find_open(kPairs, 77, method);
  EXPECT_EQ(found.pairs, kPairs);
  EXPECT_GE(found.free, kPairs / 2);
  EXPECT_GE(found.conflict, 10U);
  EXPECT_LE(found.open.size(), open_max);
  for (const OpenPair& pair : found.open) {
    EXPECT_LT(pair.keeps_m, kCloseClearance_m + kHardly_m) << "pair " << pair.pair;
  }
}

TEST(OpenPairs, UndecidedPairsOfSweptMotionsHaveADistanceNearTheClearance) {
  expect_open_only_where_close(Swept{0.001}, 2);
}

TEST(OpenPairs, UndecidedConflictRegionsHaveADistanceNearTheClearance) {
  expect_open_only_where_close(Coordinated{0.001}, 4);
}

}  // namespace
}  // namespace armloom::soundness
