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

// A requested plan. Any thread may set `cancelled`: the requester, or the pool when it ends.
struct PlanTask {
  PlanQuestion question;
  PlanningScenePtr scene;
  std::shared_ptr<std::atomic<bool>> cancelled;
  std::function<void(PlanAnswer)> done;
  std::optional<PlanRefusal> known = {};  // the cached answer, if there is one (RefusedPlans)
};
// Thread-safe.
[[nodiscard]] inline PlanAnswer answer_of(const PlanTask& task) {
  if (task.known) return tl::unexpected(*task.known);
  return answer_plan(task.scene, task.question, task.cancelled.get());
}

struct PlanInquiry {
  std::string arm;
  std::vector<std::string> arms;  // instead of `arm`: whichever arrives first
  PlanGoal to;
  std::optional<PlanGoal> from;  // nullopt: where the arm will be after all admitted jobs
  std::uint64_t seed = 1;
  std::optional<double> speed = {};  // MotionGoal::speed; nullopt: the cell's
  std::optional<int> budget = {};    // PlanQuestion::budget, from 1 to kPlanBudgetMax
};
// A larger budget would keep a worker busy for minutes.
inline constexpr int kPlanBudgetMax = 10 * static_cast<int>(PlanRequest::kDefaultBudget);

struct OtherArm {
  std::string arm;
  std::optional<double> arrives_s;  // from now, as a job
  std::string detail;
};

struct PlanView {
  std::string arm;
  std::vector<OtherArm> others;
  PlannedMotion motion;
  double length;                // in joint space (rad, m), ...
  double straight_line_length;  // ... and of the straight line
  // Result of check() for this motion, or why it was not checked (its start is not where the arm
  // will be).
  Result<CheckView> verdict;
};

// Why there is no plan (of several arms: the first arm's kind and place), and the offending member
// of the inquiry.
struct RefusedInquiry {
  PlanRefusal why;
  std::string pointer = {};  // JSON pointer; empty if the cause is not in the inquiry
  decltype(Problem::value) value = {};
};
using PlanOutcome = tl::expected<PlanView, RefusedInquiry>;

}  // namespace armloom
