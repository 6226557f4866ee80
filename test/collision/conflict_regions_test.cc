#include "core/collision/check/conflict_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/collision/check/pair_regions.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Evidence = BlockedCell::Evidence;

BlockedCell cell(Duration from_a, Duration to_a, Duration from_b, Duration to_b) {
  return {{from_a, to_a, from_b, to_b}, Evidence::none, 0.0};
}
// Both arms are at the start of a 10 s motion.
constexpr ProgressBox kAll{0s, 10s, 0s, 10s};

bool holds(const ProgressBox& box, Duration a, Duration b) {
  return box.from_a <= a && a <= box.to_a && box.from_b <= b && b <= box.to_b;
}
bool hold(const std::vector<BlockedRegion>& regions, Duration a, Duration b) {
  return std::ranges::any_of(regions, [&](const BlockedRegion& region) {
    return std::ranges::any_of(region.boxes,
                               [&](const ProgressBox& box) { return holds(box, a, b); });
  });
}
void expect_box(const ProgressBox& box, Duration from_a, Duration to_a, Duration from_b,
                Duration to_b) {
  EXPECT_EQ(box.from_a, from_a);
  EXPECT_EQ(box.to_a, to_a);
  EXPECT_EQ(box.from_b, from_b);
  EXPECT_EQ(box.to_b, to_b);
}

// Waiting at a region's edge costs up to the duration of one fine cell.
TEST(PairRegionSearch, ResolutionFollowsTheShorterMotion) {
  const auto fine = [](Duration shorter) {
    return PairRegionSearch::resolution_of(shorter).passing.fine;
  };
  for (const Duration shorter : {Duration(0s), Duration(1s), Duration(5s)}) {
    const auto resolution = PairRegionSearch::resolution_of(shorter);
    EXPECT_EQ(resolution.fine, 80ms);
    EXPECT_EQ(resolution.passing.fine, 25ms);
  }
  EXPECT_EQ(fine(7500ms), 37500us);
  EXPECT_EQ(fine(10s), 50ms);
  EXPECT_EQ(fine(60s), 50ms);
  const auto widest = PairRegionSearch::resolution_of(60s);
  EXPECT_EQ(widest.fine, 160ms);
  EXPECT_EQ(widest.coarse, 160ms);
  EXPECT_EQ(widest.passing.coarse, 160ms);
}

TEST(BlockedRegions, AreEmptyWithoutCells) { EXPECT_TRUE(blocked_regions({}, kAll).empty()); }

TEST(BlockedRegions, JoinCellsWhoseCornersTouch) {
  const BlockedCell first = cell(1s, 2s, 1s, 2s);
  EXPECT_EQ(blocked_regions({first, cell(2s, 3s, 2s, 3s)}, kAll).size(), 1U);
  EXPECT_EQ(blocked_regions({first, cell(2s, 3s, 0s, 1s)}, kAll).size(), 1U);
  EXPECT_EQ(blocked_regions({first, cell(2s + 1ns, 3s, 2s + 1ns, 3s)}, kAll).size(), 1U);
  EXPECT_EQ(blocked_regions({first, cell(2s + 2ns, 3s, 2s, 3s)}, kAll).size(), 2U);
  EXPECT_EQ(blocked_regions({first, cell(1s, 2s, 2s + 2ns, 3s)}, kAll).size(), 2U);
}

TEST(BlockedRegions, MergeCellsIntoFewBoxes) {
  std::vector<BlockedCell> cells;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 4; ++j) cells.push_back(cell(i * 1s, (i + 1) * 1s, j * 1s, (j + 1) * 1s));
  }
  const auto regions = blocked_regions(cells, kAll);
  ASSERT_EQ(regions.size(), 1U);
  ASSERT_EQ(regions[0].boxes.size(), 1U);
  expect_box(regions[0].boxes[0], 0s, 8s, 0s, 4s);
}

TEST(BlockedRegions, CutInTheDirectionWithFewerBoxes) {
  // A comb with three teeth along B. If cut across its back it would have five boxes instead of
  // four.
  std::vector<BlockedCell> comb{cell(0s, 5s, 0s, 1s), cell(0s, 1s, 1s, 3s), cell(2s, 3s, 1s, 4s),
                                cell(4s, 5s, 1s, 5s)};
  for (const bool along_a : {false, true}) {
    if (along_a) {
      for (auto& [box, evidence, distance_m] : comb) {
        box = {box.from_b, box.to_b, box.from_a, box.to_a};
      }
    }
    const auto regions = blocked_regions(comb, kAll);
    ASSERT_EQ(regions.size(), 1U);
    EXPECT_EQ(regions[0].boxes.size(), 4U);
  }
}

TEST(BlockedRegions, FillEnclosedHoles) {
  std::vector<BlockedCell> ring{cell(0s, 5s, 0s, 1s), cell(0s, 5s, 4s, 5s), cell(0s, 1s, 1s, 4s),
                                cell(4s, 5s, 1s, 4s), cell(2s, 3s, 2s, 3s)};
  const ProgressBox before{0s, 10s, 0s, 10s};
  const auto filled = blocked_regions(ring, before);
  ASSERT_EQ(filled.size(), 1U);
  ASSERT_EQ(filled[0].boxes.size(), 1U);
  expect_box(filled[0].boxes[0], 0s, 5s, 0s, 5s);

  ring.erase(ring.begin() + 2);  // open to one side
  EXPECT_FALSE(hold(blocked_regions(ring, before), 1500ms, 1500ms));
  EXPECT_EQ(blocked_regions(ring, before).size(), 2U);
}

TEST(BlockedRegions, KeepTheCurrentPositionFree) {
  const std::vector<BlockedCell> ring{cell(0s, 5s, 0s, 1s), cell(0s, 5s, 4s, 5s),
                                      cell(0s, 1s, 1s, 4s), cell(4s, 5s, 1s, 4s)};
  const auto regions = blocked_regions(ring, {2s, 10s, 2s, 10s});
  EXPECT_FALSE(hold(regions, 2s, 2s));
  EXPECT_FALSE(hold(regions, 3s, 3s));
  EXPECT_TRUE(hold(regions, 4s, 3s));
}

TEST(BlockedRegions, DropCellsBehindBothArms) {
  const ProgressBox remaining{3s, 10s, 0s, 0s};
  const std::vector<BlockedCell> cells{cell(1s, 2s, 0s, 0s), cell(5s, 6s, 0s, 0s)};
  const auto regions = blocked_regions(cells, remaining);
  ASSERT_EQ(regions.size(), 1U);
  expect_box(regions[0].boxes[0], 5s, 6s, 0s, 0s);
  // A cell that ends at the current position is not behind the arms.
  EXPECT_EQ(blocked_regions({cell(1s, 3s, 0s, 0s)}, remaining).size(), 1U);
  EXPECT_EQ(blocked_regions({cell(9s, 10s, 0s, 0s)}, {10s, 10s, 0s, 0s}).size(), 1U);
}

TEST(BlockedRegions, ReportTheStrongestEvidence) {
  std::vector<BlockedCell> cells{cell(0s, 1s, 0s, 1s), cell(1s, 3s, 0s, 1s), cell(3s, 4s, 0s, 1s)};
  EXPECT_EQ(blocked_regions(cells, kAll)[0].evidence, 1U);
  cells[0].evidence = cells[2].evidence = Evidence::distance;
  cells[0].distance_m = 0.3;
  cells[2].distance_m = 0.2;
  EXPECT_EQ(blocked_regions(cells, kAll)[0].evidence, 2U);
  cells[0].evidence = Evidence::proven;
  EXPECT_EQ(blocked_regions(cells, kAll)[0].evidence, 0U);
}

// A grid through all edges of these cells would have 1.6e9 fields.
TEST(BlockedRegions, UseMemoryProportionalToTheCells) {
  constexpr int kCells = 20'000;
  std::vector<BlockedCell> cells;
  for (int i = 0; i < kCells; ++i) {
    cells.push_back(cell(i * 30ms, i * 30ms + 20ms, i * 30ms, i * 30ms + 20ms));
  }
  EXPECT_EQ(blocked_regions(cells, {0s, 600s, 0s, 600s}).size(), cells.size());
}

// The boxes must contain all random cells, but no field that is connected to the outside. They must
// be connected in the same way as in a brute-force search.
TEST(BlockedRegions, ContainAllCellsAndOnlyWhatTheyEnclose) {
  std::mt19937_64 random(17);
  for (int round = 0; round < 300; ++round) {
    constexpr int kFields = 16;
    std::vector<BlockedCell> cells;
    bool blocked[kFields][kFields] = {};
    const std::size_t count = 1 + random() % 40;
    while (cells.size() < count) {
      const int width = 1 << (random() % 3);
      const int a = static_cast<int>(random() % kFields) / width * width;
      const int b = static_cast<int>(random() % kFields) / width * width;
      cells.push_back(cell(a * 1s, (a + width) * 1s, b * 1s, (b + width) * 1s));
      for (int i = a; i < a + width; ++i) std::fill_n(blocked[i] + b, width, true);
    }
    const ProgressBox remaining{0s, kFields * 1s, 0s, kFields * 1s};
    const auto regions = blocked_regions(cells, remaining);
    // Free fields connected to the border.
    bool outside[kFields][kFields] = {};
    for (bool grows = true; grows;) {
      grows = false;
      for (int i = 0; i < kFields; ++i) {
        for (int j = 0; j < kFields; ++j) {
          if (blocked[i][j] || outside[i][j]) continue;
          const bool rim = i == 0 || j == 0 || i == kFields - 1 || j == kFields - 1;
          if (rim || outside[i - 1][j] || outside[i + 1][j] || outside[i][j - 1] ||
              outside[i][j + 1]) {
            outside[i][j] = grows = true;
          }
        }
      }
    }
    for (int i = 0; i < kFields; ++i) {
      for (int j = 0; j < kFields; ++j) {
        ASSERT_EQ(hold(regions, i * 1s + 500ms, j * 1s + 500ms), !outside[i][j])
            << round << ": " << i << ", " << j;
      }
    }
    for (std::size_t x = 0; x < regions.size(); ++x) {
      for (std::size_t y = x + 1; y < regions.size(); ++y) {
        for (const ProgressBox& one : regions[x].boxes) {
          for (const ProgressBox& other : regions[y].boxes) {
            ASSERT_TRUE(one.to_a < other.from_a || other.to_a < one.from_a ||
                        one.to_b < other.from_b || other.to_b < one.from_b);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace armloom
