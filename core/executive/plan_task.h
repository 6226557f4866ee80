#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/collision/scene/planning_scene.h"
#include "core/executive/events.h"
#include "core/planning/answer_plan.h"
#include "core/planning/plan_goal.h"

namespace armloom {

// A plan that is asked for. `cancelled` may be set by any thread; what asked for it, or the pool
// when it ends.
struct PlanTask {
  PlanQuestion question;
  PlanningScenePtr scene;
  std::shared_ptr<std::atomic<bool>> cancelled;
  std::function<void(PlanAnswer)> done;
  std::optional<PlanRefusal> known = {};  // the answer, where it was asked before (RefusedPlans)
};
// Thread-safe.
[[nodiscard]] inline PlanAnswer answer_of(const PlanTask& task) {
  if (task.known) return tl::unexpected(*task.known);
  return answer_plan(task.scene, task.question, task.cancelled.get());
}

// What a client asks: how an arm would get somewhere.
struct PlanInquiry {
  std::string arm;
  std::vector<std::string> arms;  // instead: whichever of these arrives first
  PlanGoal to;
  std::optional<PlanGoal> from;  // absent: where the arm will be when what is admitted has run
  std::uint64_t seed = 1;
  std::optional<double> speed = {};  // MotionGoal::speed; absent: the cell's
  std::optional<int> budget = {};    // PlanQuestion::budget, from 1 to kPlanBudgetMax
};
// More would keep a worker for minutes.
inline constexpr int kPlanBudgetMax = 10 * static_cast<int>(PlanRequest::kDefaultBudget);

// What became of an arm that could have gone there instead.
struct OtherArm {
  std::string arm;
  std::optional<double> arrives_s;  // from now, as a job
  std::string detail;               // why it is not that one
};

// A motion that nobody has been asked to make.
struct PlanView {
  std::string arm;
  std::vector<OtherArm> others;
  PlannedMotion motion;
  double length;                // in joint space (rad, m), ...
  double straight_line_length;  // ... and of the straight line
  // What would become of it as a job now; or why that is not told: it begins elsewhere.
  Result<CheckView> verdict;
};

// Why there is none, and what of the inquiry is at fault: of several arms with the kind and place
// of the first.
struct RefusedInquiry {
  PlanRefusal why;
  std::string pointer = {};  // JSON pointer into it; empty: nothing that it says
  decltype(Problem::value) value = {};
};
using PlanOutcome = tl::expected<PlanView, RefusedInquiry>;

}  // namespace armloom
