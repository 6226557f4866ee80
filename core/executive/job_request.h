#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "core/jobs/job_terms.h"
#include "core/planning/plan_goal.h"
#include "core/trajectory/validate.h"

namespace armloom {

// A job as a client asks for it, its JSON already read.
struct JobRequest {
  std::string key;  // the client's id; empty: one is given ("job-17")
  std::string name;
  TrajectoryRequest trajectory;  // not read where there are alternatives, or a goal
  // The same work by several arms, of which one will do it: each moves one arm, and back to where
  // it begins. None, or at least two.
  std::vector<TrajectoryRequest> alternatives = {};
  // Instead: where this arm is to go, or whichever of these arrives first, and at which share of
  // its speed (absent: the cell's).
  std::optional<PlanGoal> move_to = {};
  std::string arm = {};
  std::vector<std::string> arms = {};
  std::optional<double> speed = {};
  JobTerms terms = {};
  std::vector<std::string> after;  // keys of jobs that have to succeed first
  // What was found out before the strand has it.
  struct Known {
    // Of `after`, those that have succeeded, in a former run or long ago.
    std::vector<std::string> succeeded = {};
    // What validate() makes of each of motions() (validated.h): it takes time that the strand has
    // not. Empty: nobody has asked.
    std::vector<Result<TrajectoryPtr>> validated = {};
  } known = {};
  // As it came, for who writes down what did. Null: nobody does.
  std::shared_ptr<const std::string> body = {};

  // The trajectory, or the alternatives, each with its place in the request ("/alternatives/0").
  struct PlacedMotion {
    std::string place;
    const TrajectoryRequest& motion;
  };
  [[nodiscard]] std::vector<PlacedMotion> motions() const;
};

// What is to be changed of a job that was accepted, as JobRequest has it; what is absent stays.
struct JobAmendment {
  std::optional<std::string> name = {};
  AmendedTerms terms = {};
};

}  // namespace armloom
