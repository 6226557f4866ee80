#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/audit/audit.h"
#include "core/collision/check/motion_checker.h"
#include "core/collision/state/check_home.h"
#include "core/collision/state/clearance_query.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"
#include "test/collision/walled_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

using small::As;
using small::walled;

constexpr ArmId kA{0};
constexpr ArmId kB{1};

PlanningScenePtr scene_of(const CellPtr& cell) { return *PlanningScene::build(cell); }

std::vector<CheckMethod> methods() {
  return {TimedDiscrete{20ms}, Swept{0.001}, Coordinated{0.001}};
}

Question question(const Cell& cell, const CheckMethod& method, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto angle = [&](double most) {
    return (2.0 * static_cast<double>(random() >> 11U) / 9007199254740992.0 - 1.0) * most;
  };
  Question asked{.version = 1,
                 .start_at = TimePoint{},
                 .candidates = {},
                 .others = {},
                 .rest = cell.home(),
                 .method = method};
  const double down = -0.5;
  asked.candidates = {
      {StepId{JobId{1}}, small::sweep(cell, {kA}, {down, 0.0}, {angle(1.2), angle(1.5)}, 2s), 0s}};
  asked.others = {
      {StepId{JobId{2}}, small::sweep(cell, {kB}, {down, 0.0}, {angle(1.2), angle(1.5)}, 3s), 0s}};
  return asked;
}

// Returns "wall" for the arm's pedestal, too: if the wall carries the arm, both belong to one link.
std::string named(const std::string& body) { return body == "a_base" ? "wall" : body; }

void expect_same(const Verdict& link, const Verdict& object, const std::string& where) {
  EXPECT_EQ(link.kind, object.kind) << where;
  EXPECT_EQ(link.clearance_bound, object.clearance_bound) << where;
  EXPECT_EQ(link.evaluations, object.evaluations) << where;
  EXPECT_EQ(link.regions.size(), object.regions.size()) << where;
  ASSERT_EQ(link.conflicts.size(), object.conflicts.size()) << where;
  for (std::size_t i = 0; i < link.conflicts.size(); ++i) {
    const Conflict& a = link.conflicts[i];
    const Conflict& b = object.conflicts[i];
    EXPECT_EQ(a.with, b.with) << where;
    EXPECT_EQ(a.proximity.body_a, b.proximity.body_a) << where;
    EXPECT_EQ(named(a.proximity.body_b), named(b.proximity.body_b)) << where;
    EXPECT_EQ(a.proximity.arm_b, b.proximity.arm_b) << where;
    EXPECT_DOUBLE_EQ(a.proximity.clearance_m, b.proximity.clearance_m) << where;
    EXPECT_EQ(a.own_time, b.own_time) << where;
  }
}

TEST(SceneLinks, AreCheckedLikeObjectsByEveryMethod) {
  for (const As as : {As::link, As::mount}) {
    const CellPtr with_link = walled(as);
    const CellPtr with_object = walled(As::object);
    int met = 0;
    int free = 0;
    for (const CheckMethod& method : methods()) {
      MotionChecker of_link(scene_of(with_link));
      MotionChecker of_object(scene_of(with_object));
      for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Verdict link = of_link.judge(question(*with_link, method, seed));
        const Verdict object = of_object.judge(question(*with_object, method, seed));
        expect_same(link, object,
                    "method " + std::to_string(method.index()) + ", seed " + std::to_string(seed));
        free += link.kind == Verdict::Kind::free ? 1 : 0;
        for (const Conflict& conflict : link.conflicts) {
          if (conflict.proximity.body_b != "wall") continue;
          EXPECT_EQ(conflict.with, Conflict::With::scene);
          ++met;
        }
      }
    }
    EXPECT_GE(met, 40);
    EXPECT_GE(free, 40);
  }
}

// Returns the configuration in which the tip is gap_m from the wall. With a straight arm the tip is
// 0.03 m beyond y = 0.6 sin q; the wall is at 0.4.
Configuration tip_from_wall(const Cell& cell, double gap_m) {
  Configuration q = cell.home();
  q[0] = std::asin((0.4 - 0.03 - gap_m) / 0.6);
  return q;
}

TEST(SceneLinks, GetTheClearanceOfTheScene) {
  for (const As as : {As::link, As::object, As::mount}) {
    const CellPtr cell = walled(as);
    const PlanningScenePtr scene = scene_of(cell);
    small::ScaledQuery checker(scene);
    ClearanceQuery states(scene);
    for (const double gap_m : {0.0094, 0.0199, 0.0201}) {
      const Configuration q = tip_from_wall(*cell, gap_m);
      const Configuration* state[] = {&q};
      const bool too_close = gap_m < cell->clearances.clearance_m;
      EXPECT_EQ(states.too_close(state) != 0, too_close) << gap_m;
      EXPECT_EQ(
          checker.first_closer_than(q, cell->clearances.clearance_m, {true, true}).has_value(),
          too_close)
          << gap_m;
      const auto stops = checker.all_closer_than(q, 0.01);
      EXPECT_EQ(stops.size(), gap_m < 0.01 ? 1U : 0U);
    }
  }
}

TEST(SceneLinks, AppearInDistancesAndInTheAudit) {
  for (const As as : {As::link, As::object, As::mount}) {
    const CellPtr cell = walled(as);
    small::ScaledQuery checker(scene_of(cell));
    const Configuration q = tip_from_wall(*cell, 0.0094);
    const auto [apart, at_mount] = checker.closest_apart(q, 2.0);
    std::vector<Proximity> closest = apart;
    closest.insert(closest.end(), at_mount.begin(), at_mount.end());
    const auto at_wall = std::ranges::find_if(
        closest, [](const Proximity& pair) { return pair.arm_a == kA && pair.body_b == "wall"; });
    ASSERT_NE(at_wall, closest.end());
    EXPECT_FALSE(at_wall->arm_b);
    EXPECT_NEAR(at_wall->clearance_m, 0.0094, 1e-6);
    const auto report = audit(*cell, {{TimePoint{}, q}}, 1ms);
    ASSERT_TRUE(report && report->smallest_clearance);
    EXPECT_EQ(report->smallest_clearance->body_b == "wall" ? report->smallest_clearance->body_b
                                                           : report->smallest_clearance->body_a,
              "wall");
    EXPECT_NEAR(report->smallest_clearance->distance_m, 0.0094, 1e-6);
  }
}

// The first link is always near what the arm stands on. So that pair says nothing, unless it is too
// close.
TEST(SceneLinks, FirstLinkAndMountAreNotAmongTheClosestPairs) {
  for (const As as : {As::link, As::object, As::mount}) {
    const CellPtr cell = walled(as);
    small::ScaledQuery checker(scene_of(cell));
    for (const double gap_m : {0.0004, 0.059, 0.061, 0.2}) {
      const auto [apart, at_mount] = checker.closest_apart(tip_from_wall(*cell, gap_m), 2.0);
      const auto is_at_wall = [](const Proximity& pair) {
        return pair.arm_a == kA && pair.body_b == "wall" && pair.body_a != "a_link1";
      };
      const bool is_left_out = as == As::mount && gap_m > 0.06;
      EXPECT_EQ(std::ranges::any_of(apart, is_at_wall), !is_left_out) << gap_m;
      for (const Proximity& pair : apart) EXPECT_NE(pair.body_a, "a_link1") << gap_m;
      const bool first_link = std::ranges::any_of(
          at_mount, [](const Proximity& pair) { return pair.body_a == "a_link1"; });
      if (as == As::object) {
        EXPECT_TRUE(first_link) << gap_m;
      }
    }
  }
}

TEST(SceneLinks, IncludeTheMountButNoOwnLinks) {
  const CellPtr cell = walled(As::link);
  const LinkId mount = *cell->find_link("a_base");
  EXPECT_TRUE(cell->is_mount(mount, kA));
  EXPECT_FALSE(cell->is_mount(mount, kB));
  EXPECT_FALSE(cell->is_mount(*cell->find_link("wall"), kA));
  const LinkId first = *cell->find_link("a_link1");
  const LinkId second = *cell->find_link("a_link2");
  EXPECT_FALSE(cell->is_own(first, mount));
  EXPECT_FALSE(cell->is_own(mount, first));
  EXPECT_FALSE(cell->is_own(second, mount));
  EXPECT_TRUE(cell->is_own(first, second));
  EXPECT_FALSE(cell->is_own(second, *cell->find_link("b_link2")));
  EXPECT_FALSE(cell->is_own(mount, *cell->find_link("wall")));
  EXPECT_FALSE(cell->is_own(first, *cell->find_link("wall")));
  small::ScaledQuery checker(scene_of(cell));
  std::vector<NearPair> near;
  near = checker.near(cell->home(), 10.0);
  int mounted = 0;
  int others = 0;
  for (const NearPair& pair : near) {
    const Proximity found = checker.describe(pair);
    if (found.body_b != "a_base") continue;
    EXPECT_FALSE(checker.is_self(pair.pair)) << found.body_a;
    EXPECT_EQ(checker.is_mount(pair.pair), found.arm_a == kA) << found.body_a;
    EXPECT_NEAR(found.limit_m, 10.0, 1e-9);
    ++(found.arm_a == kB ? others : mounted);
  }
  EXPECT_EQ(mounted, 2);
  EXPECT_EQ(others, 2);
}

// Robots that fold onto their own base need a smaller clearance to their mount. The verdict must
// not claim more than that clearance.
TEST(SceneLinks, MountMayHaveItsOwnClearance) {
  Cell closer = *walled(As::mount);
  closer.clearances.mount_clearance_m = 0.008;
  const CellPtr cell = small::shared(closer);
  const PlanningScenePtr scene = scene_of(cell);
  small::ScaledQuery checker(scene);
  ClearanceQuery states(scene);
  for (const double gap_m : {0.0079, 0.0081}) {
    const Configuration q = tip_from_wall(*cell, gap_m);
    const Configuration* state[] = {&q};
    EXPECT_EQ(states.too_close(state) != 0, gap_m < 0.008) << gap_m;
    const auto found = checker.first_closer_than(q, cell->clearances.clearance_m, {true, true});
    ASSERT_EQ(found.has_value(), gap_m < 0.008) << gap_m;
    EXPECT_NEAR(found ? found->limit_m : 0.008, 0.008, 1e-12);
    // The monitor scales its own limit in the same way: 0.01 m becomes 0.004 m for the mount.
    EXPECT_TRUE(checker.all_closer_than(q, 0.01).empty());
  }
  const auto stops = checker.all_closer_than(tip_from_wall(*cell, 0.0039), 0.01);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_NEAR(stops.front().limit_m, 0.004, 1e-12);
  MotionChecker motion_checker(scene);
  const Question asked{
      .version = 1,
      .start_at = TimePoint{},
      .candidates = {{StepId{JobId{1}}, small::sweep(*cell, {kA}, {0.0, 0.0}, {0.3, 0.0}, 2s), 0s}},
      .others = {},
      .rest = cell->home(),
      .method = Swept{0.001}};
  const Verdict verdict = motion_checker.judge(asked);
  EXPECT_EQ(verdict.kind, Verdict::Kind::free);
  EXPECT_EQ(verdict.clearance_bound.value().apart_m, 0.008);
}

// If the base frame has no shape, the mount is the link to which it is fixed. Otherwise the mount
// is the base frame itself.
TEST(SceneLinks, ParentOfAMountFrameWithoutShapeIsTheMount) {
  Cell cell = *walled(As::link);
  cell.clearances.mount_clearance_m = 0.008;
  const LinkId frame = *cell.find_link("a_base");
  const LinkId wall = *cell.find_link("wall");
  Link& base = cell.links[frame.index()];
  base.parent = wall;
  base.X_PJ = small::at_xyz(0, -0.45, 0);
  const auto too_close = [&](double gap_m) {
    const CellPtr shared = small::shared(cell);
    const Configuration q = tip_from_wall(*shared, gap_m);
    const Configuration* state[] = {&q};
    return ClearanceQuery(scene_of(shared)).too_close(state) != 0;
  };
  EXPECT_TRUE(cell.is_mount(frame, kA));
  EXPECT_FALSE(cell.is_mount(wall, kA));
  EXPECT_TRUE(too_close(0.0199));
  base.shapes.clear();
  EXPECT_TRUE(cell.is_mount(wall, kA));
  EXPECT_FALSE(cell.is_mount(wall, kB));
  EXPECT_FALSE(too_close(0.0081));
  EXPECT_TRUE(too_close(0.0079));
}

// For a pair that is too close at the start and separates, the bound claims only a share of its
// first distance at the largest deviation.
TEST(ClearanceBound, ClaimsOnlyWhatEveryPairKept) {
  for (const As as : {As::link, As::object, As::mount}) {
    const CellPtr cell = walled(as);
    const Configuration q = tip_from_wall(*cell, 0.01);
    for (const CheckMethod& method : methods()) {
      if (std::holds_alternative<TimedDiscrete>(method)) continue;
      MotionChecker motion_checker(scene_of(cell));
      Question asked{.version = 1,
                     .start_at = TimePoint{},
                     .candidates = {{StepId{JobId{1}},
                                     small::sweep(*cell, {kA}, {q[0], 0.0}, {-0.5, 0.0}, 2s), 0s}},
                     .others = {},
                     .rest = cell->home(),
                     .method = method};
      const Verdict parts = motion_checker.judge(asked);
      ASSERT_EQ(parts.kind, Verdict::Kind::free) << method.index();
      ASSERT_TRUE(parts.clearance_bound);
      // The tracking error of two joints (0.001 rad each) moves the tip by up to 1 mm.
      EXPECT_LE(parts.clearance_bound->apart_m, 0.01 - kPartingLoss_m);
      EXPECT_GT(parts.clearance_bound->apart_m, 0.009 - 2.0 * kPartingLoss_m);
      asked.candidates = {
          {StepId{JobId{1}}, small::sweep(*cell, {kA}, {0.0, 0.0}, {-0.5, 0.0}, 2s), 0s}};
      const ClearanceBound all = motion_checker.judge(asked).clearance_bound.value();
      EXPECT_EQ(all.apart_m, 0.02);
      EXPECT_EQ(all.self_m, 0.005);
    }
  }
}

TEST(SceneLinks, TooCloseAtHomeAreRejectedLikeObjects) {
  for (const As as : {As::link, As::object, As::mount}) {
    Cell cell = *walled(as);
    cell.arms[0].home[0] = tip_from_wall(cell, 0.012)[0];
    const Problems problems = check_home(scene_of(small::shared(cell)));
    ASSERT_EQ(problems.size(), 1U);
    const std::string remedy =
        " (wall carries the arm: if only this link is so close to it, add [\"a_link2\", "
        "\"wall\"] to the cell's \"allowed_collisions\"; if the whole arm passes it so closely "
        "by design, and it is not a table, add \"mount_clearance_m\": 0.01";
    EXPECT_THAT(problems[0].detail,
                testing::StartsWith("a_link2 and wall: 0.0120 m apart at home, clearance_m is "
                                    "0.0200" +
                                    (as == As::mount ? remedy : "")));
  }
}

}  // namespace
}  // namespace armloom
