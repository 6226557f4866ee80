#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "core/executive/executive.h"
#include "core/jobs/inputs.h"

namespace armloom {

// Returns the scheduler's input for the answer. Ignores the answer if PlanMotion::known is set.
[[nodiscard]] PlanMade made_of(const PlanMotion& asked, PlanAnswer answer);

// The open plans of steps.
class OpenPlans {
 public:
  explicit OpenPlans(JudgementService& judges) : judges_(judges) {}  // outlives this object

  // `done` is called later, on the strand.
  void ask(const PlanMotion& asked, PlanningScenePtr scene, std::function<void(PlanMade)> done);
  // Cancels the open plans of a job that no longer needs them.
  void give_up(JobId job);
  // Returns the open plans, by step.
  [[nodiscard]] std::vector<PlanMotion> open() const;

 private:
  JudgementService& judges_;
  using Key = std::pair<StepId, std::uint64_t>;  // and PlanMotion::number
  struct Plan {
    PlanMotion asked;
    std::shared_ptr<std::atomic<bool>> given_up;
  };
  std::map<Key, Plan> plans_;
};

}  // namespace armloom
