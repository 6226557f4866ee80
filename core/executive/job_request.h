#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/executive/task_request.h"
#include "core/jobs/job_terms.h"
#include "core/planning/plan_goal.h"
#include "core/trajectory/validate.h"

namespace armloom {

// A client's request for a job, parsed from JSON.
struct JobRequest {
  std::string key;  // generated if empty ("job-17")
  std::string name;
  TrajectoryRequest trajectory;  // ignored if there are alternatives or a goal
  // Trajectories by which different arms can do the same work. Each moves one arm and ends where it
  // begins. Empty, or at least two.
  std::vector<TrajectoryRequest> alternatives = {};
  // A goal instead of a trajectory, for `arm`, or for the one of `arms` that arrives first.
  // `speed`: share of the joints' maximum speeds; nullopt: the cell's value.
  std::optional<PlanGoal> move_to = {};
  std::string arm = {};
  std::vector<std::string> arms = {};
  std::optional<double> speed = {};
  // A task: instead of a trajectory, steps that are executed in this order.
  std::vector<StepRequest> steps = {};
  JobTerms terms = {};
  std::vector<std::string> after;  // keys of jobs that must succeed first
  struct Known {
    // Jobs of `after` that have succeeded, although the executive may not know them any more.
    std::vector<std::string> succeeded = {};
    // The result of validate() for each of motions(), computed in advance because it takes too long
    // for the strand (validated.h). Empty: not validated yet.
    std::vector<Result<TrajectoryPtr>> validated = {};
  } known = {};
  // The request as received; null if no log keeps it.
  std::shared_ptr<const std::string> body = {};

  // Returns the trajectory, or the alternatives if there are any, each with its JSON pointer
  // ("/alternatives/0").
  struct PlacedMotion {
    std::string place;
    const TrajectoryRequest& motion;
  };
  [[nodiscard]] std::vector<PlacedMotion> motions() const;
};

// A client's change of a job; nullopt: unchanged.
struct JobAmendment {
  std::optional<std::string> name = {};
  AmendedTerms terms = {};
};

}  // namespace armloom
