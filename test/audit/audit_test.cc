#include "core/audit/audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/collision/small_cell.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();
constexpr double kUp = small::kHalfTurn / 2;

// Returns two arms with one 0.4 m link each and bases 0.7 m apart along x. The links overlap when
// they point at each other.
Cell pair_of_arms() {
  Cell cell;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ}, {0.4, 0.03});
  small::add_robot(cell, "b", small::at_xyz(0.7, 0, 0), {kZ}, {0.4, 0.03});
  return cell;
}

std::vector<RecordedState> turn(const std::vector<double>& from, const std::vector<double>& to,
                                Duration duration, Duration row) {
  std::vector<RecordedState> states;
  const auto size = static_cast<Eigen::Index>(from.size());
  for (Duration t = 0ms; t <= duration; t += row) {
    const double share = to_seconds(t) / to_seconds(duration);
    Configuration q(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto j = static_cast<std::size_t>(i);
      q[i] = from[j] + share * (to[j] - from[j]);
    }
    states.push_back({at(t), q});
  }
  return states;
}

AuditReport report_of(const Cell& cell, const std::vector<RecordedState>& states, Duration step) {
  auto report = audit(cell, states, step);
  EXPECT_TRUE(report.has_value());
  return *report;
}

TEST(Audit, MeasuresTheSmallestClearanceOfACleanRecording) {
  const Cell cell = pair_of_arms();
  // b's tip is closest when b points left.
  auto states = turn({kUp, 0.0}, {kUp, 2 * kUp}, 1s, 10ms);
  auto back = turn({kUp, 2 * kUp}, {kUp, 0.0}, 1s, 10ms);
  for (RecordedState& state : back) state.time += 1s;
  states.insert(states.end(), back.begin() + 1, back.end());
  const AuditReport report = report_of(cell, states, 10ms);
  EXPECT_FALSE(report.first_contact.has_value());
  ASSERT_TRUE(report.smallest_clearance.has_value());
  EXPECT_EQ(report.smallest_clearance->time, at(1s));
  EXPECT_NEAR(report.smallest_clearance->distance_m, 0.7 - 0.4 - 2 * 0.03, 1e-6);
  EXPECT_EQ(report.smallest_clearance->body_a, "a_link1");
  EXPECT_EQ(report.smallest_clearance->body_b, "b_link1");
  EXPECT_EQ(report.states_checked, 201U);
}

TEST(Audit, ReportsTheFirstContactAndItsTime) {
  const Cell cell = pair_of_arms();
  auto states = turn({kUp, 2 * kUp}, {kUp, 2 * kUp}, 1s, 10ms);
  EXPECT_FALSE(report_of(cell, states, 10ms).first_contact.has_value());
  for (std::size_t i = 40; i < 60; ++i) states[i].q[0] = 0.05;
  const AuditReport report = report_of(cell, states, 10ms);
  ASSERT_TRUE(report.first_contact.has_value());
  EXPECT_EQ(report.first_contact->time, at(400ms));
  EXPECT_EQ(report.first_contact->body_a, "a_link1");
  EXPECT_EQ(report.first_contact->body_b, "b_link1");
  EXPECT_EQ(report.first_contact->distance_m, 0.0);
  EXPECT_EQ(report.smallest_clearance->distance_m, 0.0);
}

TEST(Audit, FindsContactBetweenTwoRows) {
  const Cell cell = pair_of_arms();
  const auto states = turn({0.6, 2 * kUp}, {-0.6, 2 * kUp}, 1s, 1s);  // two rows only
  EXPECT_FALSE(report_of(cell, states, 1s).first_contact.has_value());
  const AuditReport report = report_of(cell, states, 1ms);
  ASSERT_TRUE(report.first_contact.has_value());
  EXPECT_EQ(report.states_checked, 1001U);
  // They touch when a's axis, at angle w, is two radii (0.06 m) from the center (0.3, 0) of b's tip
  // cap.
  const double touching = std::asin(0.06 / 0.3);
  const double expected_s = (0.6 - touching) / 1.2;
  EXPECT_NEAR(to_seconds(report.first_contact->time), expected_s, 0.0011);
  EXPECT_GE(to_seconds(report.first_contact->time), expected_s - 1e-6);
}

TEST(Audit, SkipsAllowedPairsAndStaticPairs) {
  Cell cell = pair_of_arms();
  cell.objects.push_back({"block", Box{{0.2, 0.2, 0.2}}, small::at_xyz(0, 0, 0)});
  cell.objects.push_back({"plate", Box{{0.2, 0.2, 0.3}}, small::at_xyz(0, 0, 0)});
  cell.allowed.link_objects.insert({LinkId{1}, "block"});
  cell.allowed.link_objects.insert({LinkId{1}, "plate"});
  const auto states = turn({kUp, kUp}, {2 * kUp, kUp}, 100ms, 10ms);
  EXPECT_FALSE(report_of(cell, states, 10ms).first_contact.has_value());
  cell.allowed.link_objects.erase({LinkId{1}, "plate"});
  const AuditReport report = report_of(cell, states, 10ms);
  ASSERT_TRUE(report.first_contact.has_value());
  EXPECT_EQ(report.first_contact->time, at(0ms));
  EXPECT_EQ(report.first_contact->body_b, "plate");
}

TEST(Audit, ReportsABodyInsideAnotherAsContact) {
  Cell cell = pair_of_arms();
  cell.objects.push_back({"crate", Box{{2, 2, 2}}, small::at_xyz(0, 0, 0)});
  const AuditReport report = report_of(cell, turn({kUp, kUp}, {kUp, kUp}, 10ms, 10ms), 10ms);
  ASSERT_TRUE(report.first_contact.has_value());
  EXPECT_EQ(report.first_contact->body_b, "crate");
}

TEST(Audit, ChecksSelfPairsForContactOnly) {
  Cell cell;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ, kZ, kZ}, {0.3, 0.03});
  const auto folding = turn({0, 0, 0}, {0, 2.6, 2.6}, 1s, 1ms);
  const AuditReport report = report_of(cell, folding, 1ms);
  ASSERT_TRUE(report.first_contact.has_value());
  EXPECT_EQ(report.first_contact->body_a, "a_link1");
  EXPECT_EQ(report.first_contact->body_b, "a_link3");
  EXPECT_GT(report.first_contact->time, at(500ms));
  EXPECT_FALSE(report.smallest_clearance.has_value());
}

// The audit skips pairs that have not moved far enough.
TEST(Audit, MatchesAnAuditOfEachStateAlone) {
  Cell cell = pair_of_arms();
  Eigen::Isometry3d leaning = small::at_xyz(0.35, 0.45, 0);
  leaning.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX()));
  cell.objects.push_back({"rod", Cylinder{0.015, 0.5}, leaning});
  std::vector<RecordedState> states;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i;
    states.push_back({at(from_seconds(t)), Eigen::Vector2d(kUp + 0.45 * std::sin(1.7 * t),
                                                           kUp - 0.4 * std::sin(2.3 * t))});
  }
  const AuditReport whole = report_of(cell, states, 5ms);
  double smallest = std::numeric_limits<double>::infinity();
  std::optional<TimePoint> contact;
  for (const RecordedState& state : states) {
    const AuditReport one = report_of(cell, {state}, 5ms);
    smallest = std::min(smallest, one.smallest_clearance->distance_m);
    if (one.first_contact && !contact) contact = state.time;
  }
  EXPECT_EQ(whole.first_contact.has_value(), contact.has_value());
  EXPECT_DOUBLE_EQ(whole.smallest_clearance->distance_m, smallest);
  EXPECT_GT(smallest, 0.0);
}

TEST(Audit, RejectsUnloadedMeshesAndNaN) {
  Cell cell = pair_of_arms();
  auto states = turn({kUp, kUp}, {kUp, kUp}, 20ms, 10ms);
  states[1].q[0] = std::numeric_limits<double>::quiet_NaN();
  const auto broken = audit(cell, states, 10ms);
  ASSERT_FALSE(broken.has_value());
  EXPECT_THAT(broken.error()[0].pointer, ::testing::HasSubstr("0.010"));
  small::add_shape(cell.links[1], Mesh{"hand.stl"}, Eigen::Isometry3d::Identity());
  const auto mesh = audit(cell, {}, 10ms);
  ASSERT_FALSE(mesh.has_value());
  EXPECT_EQ(mesh.error()[0].kind, ProblemKind::unsupported);
}

TEST(Audit, ThrowsOnNonIncreasingTimesAndZeroStep) {
  const Cell cell = pair_of_arms();
  auto states = turn({kUp, kUp}, {kUp, kUp}, 20ms, 10ms);
  EXPECT_THROW((void)audit(cell, states, 0ms), std::invalid_argument);
  states[2].time = states[1].time;
  EXPECT_THROW((void)audit(cell, states, 10ms), std::invalid_argument);
}

}  // namespace
}  // namespace armloom
