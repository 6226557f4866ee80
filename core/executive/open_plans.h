#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>

#include "core/executive/executive.h"
#include "core/jobs/inputs.h"

namespace armloom {

// The ways to the goals of jobs that are being planned.
class OpenPlans {
 public:
  explicit OpenPlans(JudgementService& judges) : judges_(judges) {}  // outlives it

  // `done` is called on the strand, later.
  void ask(const PlanMotion& asked, PlanningScenePtr scene, std::function<void(PlanMade)> done);
  // The job needs none any more.
  void give_up(JobId job);

 private:
  JudgementService& judges_;
  std::map<JobId, std::shared_ptr<std::atomic<bool>>> given_up_;
};

}  // namespace armloom
