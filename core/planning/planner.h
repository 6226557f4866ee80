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

// A joint that stands, or is to stand, beyond its limits.
struct OutsideLimits {
  bool at_start;
  std::size_t joint;  // of the arm's
  double position;    // rad or m
};

// Why there is no plan. The cell's words: links, distances, what would have been enough.
struct PlanRefusal {
  enum class Reason {
    outside_limits,      // a joint of the start or goal
    start_in_collision,  // something is closer than its limit where the arm stands
    goal_in_collision,   // ... at every goal; `proximity` is of the first
    goal_not_reached,    // inverse kinematics found no such pose (pose_goal.h)
    not_found,           // no way within the budget: there may be one
    line_broken,         // a straight line of the link that the arm cannot follow (tool_line.h)
    line_blocked,        // ... on which it comes too close to something
    cancelled,
  };
  Reason reason;
  std::string detail;                       // one sentence
  std::optional<Proximity> proximity = {};  // of collisions
  std::uint64_t evaluations = 0;
  // Joint positions that would do, the nearest to what was asked that are known: the nearest free
  // ones; of a pose that is not reached those that come nearest to it; of a straight line those as
  // far as it goes.
  std::optional<Eigen::VectorXd> nearest = {};
  std::optional<std::string> link = {};       // that is not brought to its pose, or along its line
  std::optional<OutsideLimits> outside = {};  // the first one; of outside_limits
  // It is where the arm stands that is at fault, not where it is to go.
  [[nodiscard]] bool is_of_start() const {
    return reason == Reason::start_in_collision || (outside && outside->at_start);
  }
};
// "start-in-collision": for programs.
[[nodiscard]] std::string reason_name(PlanRefusal::Reason reason);

// A way of one arm from where it stands to one of some goals, everything else standing still.
struct PlanRequest {
  ArmId arm;
  Configuration at;                    // of the whole cell: the arm's own joints are the start
  std::vector<Eigen::VectorXd> goals;  // one or more, rows as the arm's joints
  std::vector<ArmId> left_out = {};    // other arms that are as good as gone
  std::uint64_t seed = 1;
  // Stretches of lines that may be looked at (LineChecker::evaluations), shortening included.
  // 250 comparisons of tree nodes count as one stretch.
  std::uint64_t budget = kDefaultBudget;
  const std::atomic<bool>* cancelled = nullptr;  // read now and then

  inline static constexpr std::uint64_t kDefaultBudget = 400'000;
};

struct JointWay {
  std::vector<Eigen::VectorXd> points;  // from the start to the goal; each line between two proven
  std::size_t goal = 0;                 // which of the request's
  std::uint64_t evaluations = 0;
  [[nodiscard]] double length() const;  // Euclidean, in joint space
};

// Geometric planning in one scene. The straight line first; then RRT-Connect (Kuffner and LaValle
// 2000, as OMPL has it) between the start and all goals; what it finds is shortened by lines
// between random places of it. Every line is proven by LineChecker, with the clearances and the
// tracking error of the cell, for its whole length. Continuous joints: the way is as long as the
// goal says, they are not wrapped.
//
// The same request in the same scene gives the same way (one machine; budgets count, no clock).
// Holds no state but the scene: thread-safe. Throws std::invalid_argument where sizes do not fit.
class Planner {
 public:
  explicit Planner(PlanningScenePtr scene) : scene_(std::move(scene)) {}
  [[nodiscard]] tl::expected<JointWay, PlanRefusal> plan(const PlanRequest& request) const;
  [[nodiscard]] const PlanningScenePtr& scene() const { return scene_; }

 private:
  PlanningScenePtr scene_;
};

// "left_link7 is 3 mm from table; 20 mm are asked". `moves_m`: what the two may move on top, as the
// tracking error lets them, where the distance alone would do (LineChecker::Answer).
[[nodiscard]] std::string in_words(const Proximity& proximity, double moves_m = 0.0);

}  // namespace armloom
