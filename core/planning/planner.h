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
  std::size_t joint;  // of the arm's
  double position;    // rad or m
};

// Why there is no plan, with links, distances and required clearances.
struct PlanRefusal {
  enum class Reason {
    outside_limits,      // a joint of the start or goal
    start_in_collision,  // something is too close at the start
    goal_in_collision,   // ... at every goal; `proximity` is of the first
    goal_not_reached,    // inverse kinematics found no solution (pose_goal.h)
    not_found,           // no path within the budget; one may exist
    line_broken,         // the arm cannot follow the link's straight line (tool_line.h)
    line_blocked,        // ... on which something is too close
    cancelled,
  };
  Reason reason;
  std::string detail;                       // one sentence
  std::optional<Proximity> proximity = {};  // of collisions
  std::uint64_t evaluations = 0;
  // Nearest known joint positions that would work: the nearest free ones; those nearest to an
  // unreachable pose; the last on a straight line.
  std::optional<Eigen::VectorXd> nearest = {};
  std::optional<std::string> link = {};       // not at its pose or line
  std::optional<OutsideLimits> outside = {};  // the first; for outside_limits
  // Returns true if the start is at fault, not the goal.
  [[nodiscard]] bool is_of_start() const {
    return reason == Reason::start_in_collision || (outside && outside->at_start);
  }
};
// Returns "start-in-collision" etc., for programs.
[[nodiscard]] std::string reason_name(PlanRefusal::Reason reason);

// A path of one arm to one of some goals, everything else at rest.
struct PlanRequest {
  ArmId arm;
  Configuration at;                    // of the whole cell: the arm's own joints are the start
  std::vector<Eigen::VectorXd> goals;  // at least one; a row for each joint of the arm
  std::vector<ArmId> left_out = {};    // other arms that are ignored
  std::uint64_t seed = 1;
  // Maximum number of line stretches to check (LineChecker::evaluations), with shortening. 250
  // comparisons of tree nodes count as one stretch.
  std::uint64_t budget = kDefaultBudget;
  const std::atomic<bool>* cancelled = nullptr;  // polled

  inline static constexpr std::uint64_t kDefaultBudget = 400'000;
};

struct JointWay {
  std::vector<Eigen::VectorXd> points;  // from start to goal; certified between any two
  std::size_t goal = 0;                 // index in the request
  std::uint64_t evaluations = 0;
  [[nodiscard]] double length() const;  // Euclidean, in joint space
};

// Geometric planning in one scene: the straight line first, then RRT-Connect (Kuffner and LaValle
// 2000, by OMPL) between the start and all goals, shortened by lines between random positions.
// LineChecker certifies every line for its whole length, with the cell's clearances and tracking
// error. Continuous joints are not wrapped.
//
// Deterministic on one machine: budgets count evaluations, not time. Stateless: thread-safe. Throws
// std::invalid_argument if sizes do not match.
class Planner {
 public:
  explicit Planner(PlanningScenePtr scene) : scene_(std::move(scene)) {}
  [[nodiscard]] tl::expected<JointWay, PlanRefusal> plan(const PlanRequest& request) const;
  [[nodiscard]] const PlanningScenePtr& scene() const { return scene_; }

 private:
  PlanningScenePtr scene_;
};

// Returns "left_link7 is 3 mm from table; 20 mm are required". `moves_m` is the motion of both
// within the tracking error, if only this makes them too close (LineChecker::Answer).
[[nodiscard]] std::string in_words(const Proximity& proximity, double moves_m = 0.0);

}  // namespace armloom
