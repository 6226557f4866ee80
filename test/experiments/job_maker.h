#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "test/experiments/moves.h"
#include "test/experiments/open_places.h"

namespace armloom::experiments {

struct JobDelay {
  double late_s;
  double speed;  // (0, 1], share of the planned speed
};

struct PlannedJob {
  ArmId arm;
  std::string kind;  // "pick", "place", ...
  TimedJob timed;
  TrajectoryPtr trajectory;
  std::optional<JobDelay> delay = {};
};

// Draws jobs for one cell. Every job can run when its arm is at its start and other arms rest at
// home or at the end of any job, so no policy runs into a dead end. Deterministic for equal cell,
// seed and calls. Not thread-safe.
class JobMaker {
 public:
  JobMaker(CellPtr cell, std::uint64_t seed);

  [[nodiscard]] const Cell& cell() const { return *cell_; }
  [[nodiscard]] std::mt19937_64& random() { return random_; }
  [[nodiscard]] double draw(double from, double to) { return uniform(random_, from, to); }

  // Returns joint positions with the tool down at a point, or nullopt if out of reach.
  [[nodiscard]] std::optional<Eigen::VectorXd> tool_at(ArmId arm,
                                                       const Eigen::Vector3d& p_WT) const;
  [[nodiscard]] Eigen::Vector3d from_base(ArmId arm, const Eigen::Vector3d& p_BT) const;
  [[nodiscard]] const Eigen::VectorXd& home(ArmId arm) const { return cell_->arm(arm).home; }

  struct Draft {
    std::string kind;
    std::vector<Leg> legs;
    int priority = 0;
  };
  // Appends jobs; each starts at the end of the previous job. If a job is not open (open_places.h),
  // adds none and returns false. Throws std::runtime_error if a draft violates limits.
  [[nodiscard]] bool add(ArmId arm, TimePoint at, const std::vector<Draft>& drafts);
  // Appends jobs that return home together and are clear while other arms are at home. The end of
  // one job may block other arms until the arm's next job; use take(drafts.size()). Throws
  // std::invalid_argument if the jobs do not return home.
  void add_trip(ArmId arm, const std::vector<Draft>& drafts);

  [[nodiscard]] const std::vector<PlannedJob>& jobs_of(ArmId arm) const {
    return jobs_[arm.index()];
  }
  // Returns the jobs in order of time. Jobs of equal time are taken in turn, `each` jobs of one arm
  // after the other, with a random order of arms in each turn.
  [[nodiscard]] std::vector<PlannedJob> take(std::size_t each = 1);

 private:
  struct Rest {
    ArmId arm;
    Eigen::VectorXd q;
  };
  [[nodiscard]] std::vector<PlannedJob> drafted(ArmId arm, TimePoint at,
                                                const std::vector<Draft>& drafts) const;
  [[nodiscard]] bool open(const std::vector<PlannedJob>& jobs, const std::vector<Rest>& rests);

  CellPtr cell_;
  std::mt19937_64 random_;
  OpenPlaces places_;
  std::vector<std::vector<PlannedJob>> jobs_;  // by arm
  std::vector<Rest> rests_;
};

}  // namespace armloom::experiments
