#include "core/executive/open_plans.h"

#include <utility>

namespace armloom {

void OpenPlans::ask(const PlanMotion& asked, PlanningScenePtr scene,
                    std::function<void(PlanMade)> done) {
  const auto given_up = std::make_shared<std::atomic<bool>>(false);
  given_up_[asked.job] = given_up;
  const auto answered = [this, job = asked.job, number = asked.number,
                         done = std::move(done)](PlanAnswer answer) {
    given_up_.erase(job);
    PlanMade made{.job = job, .question = number, .trajectory = nullptr};
    if (answer) {
      made.trajectory = answer->timed.trajectory;
    } else {
      made.why = "no plan: " + answer.error().detail;
    }
    done(std::move(made));
  };
  judges_.plan({asked.question, std::move(scene), given_up, answered});
}

void OpenPlans::give_up(JobId job) {
  if (const auto plan = given_up_.find(job); plan != given_up_.end()) *plan->second = true;
}

}  // namespace armloom
