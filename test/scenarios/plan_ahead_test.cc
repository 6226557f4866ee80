#include "core/executive/plan_ahead.h"

#include <gtest/gtest.h>

namespace armloom {
namespace {

using namespace std::chrono_literals;
using State = DiagramCell::State;

DiagramCell cell(State state, double a0, double a1, double b0, double b1) {
  return {from_seconds(a0), from_seconds(a1), from_seconds(b0), from_seconds(b1), state};
}

// Motions of 4 s and 3 s. In conflict if A is past 2 s and B past 1 s; the cell before is
// undecided.
std::vector<DiagramCell> corner() {
  return {cell(State::free, 0, 2, 0, 3), cell(State::free, 2, 4, 0, 0.5),
          cell(State::undecided, 2, 4, 0.5, 1), cell(State::conflict, 2, 4, 1, 3)};
}

std::optional<DiagramContact> met_from(Duration a, Duration b,
                                       const std::vector<DiagramCell>& cells = corner()) {
  return first_met(cells, a, b, 4s, 3s);
}

void expect_met(const std::optional<DiagramContact>& met, State state, Duration after, Duration a,
                Duration b) {
  ASSERT_TRUE(met);
  EXPECT_EQ(met->state, state);
  EXPECT_EQ(met->after, after);
  EXPECT_EQ(met->at_a, a);
  EXPECT_EQ(met->at_b, b);
}

TEST(PlanAhead, ReportsTheFirstConflictAndItsTime) {
  expect_met(met_from(0s, 0s), State::conflict, 2s, 2s, 2s);
  expect_met(met_from(1750ms, 500ms), State::conflict, 500ms, 2250ms, 1s);
}

TEST(PlanAhead, ReportsUndecidedCellsIfThereIsNoConflict) {
  std::vector<DiagramCell> cells = corner();
  cells.pop_back();
  expect_met(met_from(1750ms, 500ms, cells), State::undecided, 250ms, 2s, 750ms);
}

TEST(PlanAhead, FindsConflictsWithAnArmAtRest) {
  expect_met(met_from(4s, 0s), State::conflict, 1s, 4s, 1s);
}

TEST(PlanAhead, FindsNothingIfTheLinePassesOrTouchesACorner) {
  EXPECT_FALSE(met_from(0s, 0s, {cell(State::free, 0, 4, 0, 3)}));
  EXPECT_FALSE(
      met_from(1s, 0s, {cell(State::conflict, 0, 2, 2, 3), cell(State::conflict, 3, 4, 0, 1)}));
  EXPECT_FALSE(met_from(1s, 0s, {cell(State::conflict, 0, 2, 1, 2)}));
}

TEST(PlanAhead, ReportsAConflictThatExistsAlready) {
  expect_met(met_from(3s, 2s), State::conflict, 0s, 3s, 2s);
  expect_met(met_from(4s, 3s), State::conflict, 0s, 4s, 3s);
}

}  // namespace
}  // namespace armloom
