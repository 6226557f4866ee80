#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"

namespace armloom {

// A joint whose start or goal position is beyond its limits.
struct OutsideLimits {
  bool at_start;
  std::size_t joint;  // index in Arm::joints
  double position;    // rad or m
};

// The reason why there is no plan. `detail` names the links, distances and required clearances.
struct PlanRefusal {
  enum class Reason {
    outside_limits,      // at the start or goal, a joint is beyond its limits
    start_in_collision,  // something is too close at the start
    goal_in_collision,   // something is too close at every goal; `proximity`: at the first
    goal_not_reached,    // inverse kinematics found no solution (pose_goal.h)
    not_found,           // no path within the budget; one may exist, except for one joint
    line_broken,         // the arm cannot follow the link's straight line (tool_line.h)
    line_blocked,        // something is too close to the arm on that line
    cancelled,
  };
  Reason reason;
  std::string detail;                       // one sentence
  std::optional<Proximity> proximity = {};  // for collisions
  std::uint64_t evaluations = 0;
  // Nearest known joint positions that would work. By reason: the nearest free positions, the
  // positions nearest to an unreachable pose, or the last positions on a straight line.
  std::optional<Eigen::VectorXd> nearest = {};
  std::optional<std::string> link = {};       // the link that misses its pose or line
  std::optional<OutsideLimits> outside = {};  // for outside_limits: the first joint
  // Returns true if the start is at fault, not the goal.
  [[nodiscard]] bool is_of_start() const {
    return reason == Reason::start_in_collision || (outside && outside->at_start);
  }
};
// Returns "start-in-collision" etc., for programs.
[[nodiscard]] std::string reason_name(PlanRefusal::Reason reason);

// Asks for a path of one arm to any of several goals, while everything else rests.
struct PlanRequest {
  ArmId arm;
  // The positions of all joints. The arm's own joints are the start; a path begins inside their
  // limits if they exceed these by at most Execution::start_tolerance_rad.
  Configuration at;
  std::vector<Eigen::VectorXd> goals;  // at least one; a row for each joint of the arm
  std::vector<ArmId> left_out = {};    // other arms that are ignored
  std::uint64_t seed = 1;
  // Maximum number of line stretches to check (LineChecker::evaluations), including those for
  // shortening. 250 comparisons of tree nodes count as one stretch.
  std::uint64_t budget = kDefaultBudget;
  const std::atomic<bool>* cancelled = nullptr;  // polled

  inline static constexpr std::uint64_t kDefaultBudget = 400'000;
};

struct JointWay {
  std::vector<Eigen::VectorXd> points;  // from start to goal, joined by certified lines
  std::size_t goal = 0;                 // index in PlanRequest::goals
  std::uint64_t evaluations = 0;
  [[nodiscard]] double length() const;  // Euclidean, in joint space
};

// Plans paths in one scene. Tries the straight lines to the goals first, then RRT-Connect (Kuffner
// and LaValle 2000; implementation: OMPL) between the start and all goals. RRT-Connect's path is
// then shortened by lines between random positions on it. LineChecker certifies every line for its
// whole length, with the cell's clearances and tracking error. Positions of continuous joints are
// not taken modulo 2 pi.
//
// Deterministic on one machine: budgets count evaluations, not time. Stateless and thus
// thread-safe. Throws std::invalid_argument if there is no goal or sizes do not match.
class Planner {
 public:
  explicit Planner(PlanningScenePtr scene) : scene_(std::move(scene)) {}
  [[nodiscard]] tl::expected<JointWay, PlanRefusal> plan(const PlanRequest& request) const;
  [[nodiscard]] const PlanningScenePtr& scene() const { return scene_; }

 private:
  PlanningScenePtr scene_;
};

// Returns "left_link7 is 3 mm from table; 20 mm are required". If the bodies are too close only
// because of the tracking error, `moves_m` is the distance that they can move within it
// (LineChecker::Answer).
[[nodiscard]] std::string in_words(const Proximity& proximity, double moves_m = 0.0);

}  // namespace armloom
