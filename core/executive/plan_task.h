#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/executive/events.h"
#include "core/executive/job_request.h"
#include "core/planning/answer_plan.h"
#include "core/planning/plan_goal.h"

namespace armloom {

// A requested plan. `cancelled` may be set by any thread: by the requester, or by the worker pool
// when it ends.
struct PlanTask {
  PlanQuestion question;
  PlanningScenePtr scene;
  std::shared_ptr<std::atomic<bool>> cancelled;
  std::function<void(PlanAnswer)> done;
  bool is_known = false;  // the requester knows that there is no path: nothing is searched
};
// Thread-safe.
[[nodiscard]] inline PlanAnswer answer_of(const PlanTask& task) {
  if (task.is_known) return tl::unexpected(PlanRefusal{PlanRefusal::Reason::not_found, {}});
  return answer_plan(task.scene, task.question, task.cancelled.get());
}

struct PlanInquiry {
  std::string arm;
  // Instead of `arm`: candidate arms, of which the first to arrive is taken.
  std::vector<std::string> arms;
  PlanGoal to;
  std::optional<PlanGoal> from;  // nullopt: where the arm will be after all admitted jobs
  std::uint64_t seed = 1;
  std::optional<double> speed = {};  // MotionGoal::speed; nullopt: the cell's
  std::optional<int> budget = {};    // PlanQuestion::budget, from 1 to kPlanBudgetMax
};
// Largest budget that a client may request: a larger one would keep a worker busy for minutes.
inline constexpr int kPlanBudgetMax = 10 * static_cast<int>(PlanRequest::kDefaultBudget);

struct OtherArm {
  std::string arm;
  std::optional<double> arrives_s;  // from now, if it were submitted as a job now
  std::string detail;
};

struct PlanView {
  std::string arm;
  std::vector<OtherArm> others;
  PlannedMotion motion;
  Duration takes;               // the motion, at the present speed override
  double length;                // in joint space (rad, m), ...
  double straight_line_length;  // ... and of the straight line
  // The result of check() for this motion, or the problem that prevents a check (its start is not
  // where the arm will be).
  Result<CheckView> verdict;
};

// Why there is no plan, and which member of the inquiry causes this. For several arms, kind and
// place are those of the first arm.
struct RefusedInquiry {
  PlanRefusal why;
  std::string pointer = {};  // JSON pointer; empty if the cause is not in the inquiry
  decltype(Problem::value) value = {};
};
using PlanOutcome = tl::expected<PlanView, RefusedInquiry>;
// Sets the place of a goal that has no plan: the joint, or the whole goal. `place`: of the goal.
void point_at_goal(const std::string& place, const PlanGoal& said, RefusedInquiry& refused);

// Asks for a plan of all motions of a job with steps. Only the steps, the arm and the speed of the
// job have an effect on the plan.
struct StepsInquiry {
  JobRequest job;
  std::uint64_t seed = 1;
  std::optional<int> budget = {};  // for each goal; PlanQuestion::budget, from 1 to kPlanBudgetMax
};
struct PlannedStep {
  std::string name;                    // may be empty
  std::string kind;                    // kind_of()
  std::string detail;                  // what it does: "part to left_hand"
  std::vector<std::string> arms = {};  // of a motion
  TrajectoryPtr motion = nullptr;      // null for actions
  std::uint64_t evaluations = 0;       // of the search for the path to a goal
};
struct StepsPlan {
  std::vector<PlannedStep> steps;  // all, or those before the first that cannot be planned
  // Why that step cannot be planned; pointers begin with "/steps/2".
  std::variant<std::monostate, RefusedInquiry, Problems> refused = {};
};

}  // namespace armloom
