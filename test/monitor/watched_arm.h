#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/monitor/premises.h"
#include "test/monitor/two_joint_arms.h"

namespace armloom {

inline const ArmId kArm{0};

// One arm that the test moves and measures.
struct Watched {
  CellPtr cell = two_joint_arms(1);
  PremiseCheck premises{cell};
  TrajectoryPtr curve = curve_of(kArm);
  Observation seen{.time = {}, .measured = Configuration::Zero(2), .arms = {ArmObservation{}}};

  ArmObservation& arm() { return seen.arms[0]; }
  // Starts the motion at zero.
  void start() {
    arm() = {.motion = curve, .authority = 2s, .rests = false};
    EXPECT_THAT(look(), testing::IsEmpty());
  }
  // The arm is measured on its path at `progress`, and commanded `lag` farther.
  void on_path(Duration progress, Duration lag = 0ms) {
    arm().measured = progress;
    arm().commanded = progress + lag;
    curve->sample_positions(progress, path);
    seen.measured = path;
  }
  // Looks 10 ms later. The controller's clock is another one.
  std::vector<MonitorFinding> look() {
    seen.time += 10ms;
    arm().reported = {1, seen.time.time_since_epoch() + slipped - arm().feedback_age};
    return premises.check(seen);
  }
  // Follows the path from `from` to `to` in real time; returns all findings.
  std::vector<MonitorFinding> follow(Duration from, Duration to) {
    std::vector<MonitorFinding> all;
    for (Duration at = from; at <= to; at += 10ms) {
      on_path(at);
      for (const MonitorFinding& found : look()) all.push_back(found);
    }
    return all;
  }
  Eigen::VectorXd path;
  Duration slipped{};  // cell time that the server lost
};

}  // namespace armloom
