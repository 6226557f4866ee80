#include "core/executive/open_plans.h"

#include <cstdio>
#include <utility>

namespace armloom {
namespace {

// Joint positions, as a goal takes them.
std::string nearest_text(const PlanRefusal& refusal) {
  if (!refusal.nearest) return "";
  std::string text;
  for (const double position : *refusal.nearest) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%.4f", text.empty() ? "" : ", ", position);
    text += number;
  }
  return "; the nearest that was found: [" + text + "]";
}

}  // namespace

PlanMade made_of(const PlanMotion& asked, PlanAnswer answer) {
  PlanMade made{.step = asked.step, .question = asked.number, .trajectory = nullptr};
  if (answer) {
    made.trajectory = answer->timed.trajectory;
    made.goes_through = answer->goes_through;
  } else {
    const PlanRefusal& refusal = answer.error();
    made.why = "no plan: " + refusal.detail + nearest_text(refusal);
    const bool is_at_start = refusal.reason == PlanRefusal::Reason::start_in_collision;
    const bool no_job_moves_it = refusal.proximity && !refusal.proximity->arm_b;
    if (is_at_start && no_job_moves_it) made.stands_in = refusal.proximity;
  }
  return made;
}

void OpenPlans::ask(const PlanMotion& asked, PlanningScenePtr scene,
                    std::function<void(PlanMade)> done) {
  const auto given_up = std::make_shared<std::atomic<bool>>(false);
  const Key key{asked.step, asked.number};
  plans_.insert_or_assign(key, Plan{asked, given_up});
  const auto answered = [this, key, scene, done = std::move(done)](PlanAnswer answer) {
    const auto node = plans_.extract(key);
    const Plan& plan = node.mapped();
    if (!*plan.given_up) refused_.learn(plan.asked.question, scene, answer);
    done(made_of(plan.asked, std::move(answer)));
  };
  PlanTask task{asked.question, std::move(scene), given_up, answered};
  refused_.tell(task);
  judges_.plan(std::move(task));
}

void OpenPlans::give_up(JobId job) {
  for (auto plan = plans_.lower_bound({StepId{job, 0}, 0}); plan != plans_.end(); ++plan) {
    if (plan->first.first.job != job) return;
    *plan->second.given_up = true;
  }
}

std::vector<PlanMotion> OpenPlans::open() const {
  std::vector<PlanMotion> open;
  for (const auto& [key, plan] : plans_) open.push_back(plan.asked);
  return open;
}

}  // namespace armloom
