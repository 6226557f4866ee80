#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/monitor/look_ahead.h"
#include "test/monitor/two_joint_arms.h"

namespace armloom {

inline constexpr Duration kPeriod = 10ms;

// Every arm is a point on one line: its first joint plus `base`. Arms meet within 0.01 m.
struct Line final : ReachGeometry {
  struct Range {
    double low, high;
  };
  Range range(const Reach& reach) const {
    const auto j = static_cast<Eigen::Index>(2 * reach.arm.index());
    double from = reach.rest[j], to = from;
    if (reach.motion) {
      Eigen::VectorXd q;
      reach.motion->sample_positions(reach.from, q);
      from = q[0];
      reach.motion->sample_positions(reach.to, q);
      to = q[0];
    }
    const double sign = signs[reach.arm.index()], at = bases[reach.arm.index()];
    const double one = at + sign * (from + reach.shift[j]), two = at + sign * (to + reach.shift[j]);
    return {std::min(one, two) - reach.error[j], std::max(one, two) + reach.error[j]};
  }
  std::optional<Proximity> may_meet(const Reach& a, const Reach& b) override {
    ++asked;
    const Range one = range(a), two = range(b);
    if (one.low > two.high + 0.01 || two.low > one.high + 0.01) return std::nullopt;
    return Proximity{.body_a = "a", .body_b = "b", .arm_a = a.arm, .arm_b = b.arm, .limit_m = 0.01};
  }
  std::optional<Proximity> may_meet_scene(const Reach& a) override {
    ++asked;
    if (!wall || range(a).high < *wall - 0.01) return std::nullopt;
    return Proximity{.body_a = "a", .body_b = "wall", .arm_a = a.arm, .limit_m = 0.01};
  }
  std::vector<double> bases, signs;
  std::optional<double> wall;
  int asked = 0;
};

struct Certificates final : CertifiedPairs {
  bool certifies(ArmId, ArmId) const override { return all; }
  bool certifies_scene(ArmId) const override { return all; }
  bool all = false;
};

// Arms that move at 1 m/s along the curve of two_joint_arms.h. A stop takes 1 / (2 * 9) s of
// trajectory time, because the path needs none of the brake of joint 0 and 1 rad/s^2 of joint 1.
struct Ahead {
  explicit Ahead(std::uint32_t arms) : cell(two_joint_arms(arms)), seen{.arms = {}} {
    seen.measured = Configuration::Zero(2 * arms);
    seen.arms.resize(arms);
    line.bases.resize(arms, 0.0);
    line.signs.resize(arms, 1.0);
  }
  void on_path(std::uint32_t a, Duration progress) {
    const TrajectoryPtr curve = curves.size() > a && curves[a] ? curves[a] : curve_of(ArmId{a});
    curves.resize(std::max<std::size_t>(curves.size(), a + 1));
    curves[a] = curve;
    Eigen::VectorXd q;
    curve->sample_positions(progress, q);
    seen.measured[2 * a] = q[0];
    seen.measured[2 * a + 1] = q[1];
    seen.arms[a].motion = curve;
    seen.arms[a].measured = seen.arms[a].commanded = progress;
    seen.arms[a].authority = 2s;
    seen.arms[a].rests = false;
  }
  std::vector<MonitorFinding> look() {
    seen.time += kPeriod;
    for (ArmObservation& arm : seen.arms) arm.reported = {1, arm.reported.at + reported_after};
    std::vector<bool> stopping(seen.arms.size(), false);
    for (const MonitorFinding& found : premises.check(seen)) {
      for (const ArmId arm : found.stops) stopping[arm.index()] = true;
    }
    return ahead.check(seen, premises, stopping, certificates, line);
  }
  Duration goes_to(ArmId arm) {
    EXPECT_THAT(premises.check(seen), testing::IsEmpty());
    return ahead.reach_of(arm, seen, premises, false).going.to;
  }
  CellPtr cell;
  PremiseCheck premises{cell};
  LookAhead ahead{cell, kPeriod};
  Observation seen;
  Duration reported_after = kPeriod;  // from report to report, on the controllers' clocks
  Certificates certificates;
  Line line;
  std::vector<TrajectoryPtr> curves;
};

}  // namespace armloom
