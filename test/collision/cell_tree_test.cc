#include "core/collision/diagram/cell_tree.h"

#include <gtest/gtest.h>

#include <chrono>

namespace armloom {
namespace {

using namespace std::chrono_literals;

// Pair 616 of `soundness open 1500 77` stayed undecided because such children became `finest`.
TEST(CellTree, LeavesChildrenUnknownIfOnlyTheirOtherAxisCanBeHalved) {
  CellTree tree(std::make_shared<TimeTree>(2 * CellTree::kFinest), std::make_shared<TimeTree>(1s));
  CellTree::Node& cell = tree.at(0);
  cell.state = CellTree::CellState::mixed;
  cell.split_a = true;
  tree.split(0, 2);
  ASSERT_EQ(tree.size(), 3);
  for (int child = 1; child < 3; ++child) {
    EXPECT_EQ(tree.at(child).state, CellTree::CellState::unknown);
    EXPECT_TRUE(tree.wider(tree.at(child), CellTree::kFinest));
  }
}

TEST(CellTree, MarksAMixedCellFinestIfNoSelectedAxisCanBeHalved) {
  CellTree tree(std::make_shared<TimeTree>(CellTree::kFinest), std::make_shared<TimeTree>(1s));
  CellTree::Node& cell = tree.at(0);
  cell.state = CellTree::CellState::mixed;
  cell.split_a = true;
  tree.split(0, 1);
  EXPECT_EQ(tree.size(), 1);
  EXPECT_EQ(tree.at(0).state, CellTree::CellState::finest);
}

}  // namespace
}  // namespace armloom
