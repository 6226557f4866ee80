#include "core/executive/open_plans.h"

#include <cstdio>
#include <utility>

namespace armloom {
namespace {

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

NoPlan none_for(const PlanRefusal& refusal) {
  using Reason = PlanRefusal::Reason;
  NoPlan none{"no plan: " + refusal.detail + nearest_text(refusal)};
  const bool is_at_start = refusal.reason == Reason::start_in_collision;
  if (refusal.reason == Reason::cancelled) none.cause = NoPlan::Cause::canceled;
  if (is_at_start || refusal.reason == Reason::goal_in_collision) {
    none.cause = NoPlan::Cause::at_end;
  }
  const bool no_job_moves_it = refusal.proximity && !refusal.proximity->arm_b;
  if (is_at_start && no_job_moves_it) none.stands_in = refusal.proximity;
  return none;
}

}  // namespace

PlanMade made_of(const PlanMotion& asked, PlanAnswer answer) {
  PlanMade made{.step = asked.step, .question = asked.number, .trajectory = nullptr};
  if (asked.known) {
    made.none = *asked.known;
  } else if (!answer) {
    made.none = none_for(answer.error());
  } else {
    made.trajectory = answer->timed.trajectory;
    made.goes_through = answer->goes_through;
    const auto& not_past = answer->not_past;
    if (not_past) made.not_past = {not_past->left_out, none_for(not_past->why)};
  }
  return made;
}

void OpenPlans::ask(const PlanMotion& asked, PlanningScenePtr scene,
                    std::function<void(PlanMade)> done) {
  const auto given_up = std::make_shared<std::atomic<bool>>(false);
  const Key key{asked.step, asked.number};
  plans_.insert_or_assign(key, Plan{asked, given_up});
  const auto answered = [this, key, done = std::move(done)](PlanAnswer answer) {
    const auto node = plans_.extract(key);
    done(made_of(node.mapped().asked, std::move(answer)));
  };
  judges_.plan({asked.question, std::move(scene), given_up, answered, asked.known.has_value()});
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
