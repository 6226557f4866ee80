#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/collision/state/clearance_query.h"
#include "core/executive/live_scene.h"
#include "test/scenarios/crossing.h"

namespace armloom {

// Jobs with steps in the crossing cell, which has a part that the arms can hold.

inline constexpr double kPart_m = 0.03;  // radius

inline CellDescription with_io() {
  CellDescription cell = crossing_description();
  cell.io.signals = {
      {.name = "valve", .direction = SignalDirection::output},
      {.name = "ready", .direction = SignalDirection::input},
      {.name = "counter", .direction = SignalDirection::output, .type = SignalType::integer},
  };
  return cell;
}

inline CollisionObject part_at(double x) {
  CollisionObject part{.name = "part", .shape = Sphere{kPart_m}};
  part.X_WO.translation() = Eigen::Vector3d(x, 0.0, 0.0);
  return part;
}

inline StepRequest slide_to(const std::string& arm, double to_m) {
  MotionStepRequest motion{.trajectory = {}, .arm = arm};
  motion.move_to = PlanGoal{.joints = std::vector{to_m}, .named = {}, .pose = {}};
  return {"", motion};
}
inline StepRequest attach(const std::string& link, std::vector<std::string> touch = {}) {
  return {"", AttachRequest{"part", link, std::move(touch)}};
}
inline StepRequest detach() { return {"", DetachRequest{"part"}}; }
inline StepRequest set(const std::string& signal, SignalValue value) {
  return {"", SetIoRequest{signal, value}};
}

inline JobRequest task(std::string key, std::vector<StepRequest> steps) {
  JobRequest request{.key = std::move(key), .name = "", .trajectory = {}};
  request.steps = std::move(steps);
  return request;
}

// From home; the part is at 0.13.
inline std::vector<StepRequest> pick_and_place() {
  return {slide_to("x", 0.0), attach("x_ball"), slide_to("x", 0.5), detach(), slide_to("x", -1.0)};
}
// The part is at -0.47. When x ends at -0.25, ball x is 5 cm from ball y at the origin, and the
// part would be in ball y.
inline std::vector<StepRequest> into_y(bool holds) {
  std::vector<StepRequest> steps{slide_to("x", -0.6), slide_to("x", -0.25)};
  if (holds) steps.insert(steps.begin() + 1, attach("x_ball"));
  return steps;
}

// Asserts in every event that the part is at exactly one place.
struct Tasks : Crossing {
  explicit Tasks(CellDescription cell = with_io(), const std::string& policy = "earliest_start")
      : Crossing(cell, policy) {
    (void)scene().add(part_at(0.13));
  }
  Executive& executive() { return simulation->executive(); }
  LiveScene& scene() { return executive().scene(); }
  void run_to_the_end(TimePoint limit = at(60s)) {
    while (!executive().all_ended() && simulation->now() < limit) {
      simulation->tick();
      EXPECT_EQ(places(), 1) << to_seconds(simulation->now().time_since_epoch());
    }
    EXPECT_TRUE(executive().all_ended());
  }
  [[nodiscard]] int places() {
    const auto is_part = [](const auto& object) { return object.name == "part"; };
    const auto is_held = [](const Attachment& held) { return held.object.name == "part"; };
    return static_cast<int>(std::ranges::count_if(scene().objects(), is_part) +
                            std::ranges::count_if(scene().scene()->attachments(), is_held));
  }
  [[nodiscard]] double x_of_part() {
    for (const CollisionObject& object : scene().objects()) {
      if (object.name == "part") return object.X_WO.translation().x();
    }
    return std::nan("");
  }
  [[nodiscard]] std::optional<SignalValue> signal(const std::string& name) {
    for (const SignalView& view : executive().signals().views()) {
      if (view.name == name) return view.value;
    }
    return std::nullopt;
  }
};

}  // namespace armloom
