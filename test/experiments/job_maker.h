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

// What goes wrong with the arm of a job (job_delays.h).
struct JobDelay {
  double late_s;
  double speed;  // (0, 1] of the planned
};

// A job as a client submits it, and what the experiments know of it.
struct PlannedJob {
  ArmId arm;
  std::string kind;  // "pick", "place", ...
  TimedJob timed;
  TrajectoryPtr trajectory;
  std::optional<JobDelay> delay = {};
};

// Draws jobs for the arms of one cell. Every job that it takes can run whenever its arm has come to
// its start and the others rest, at home or wherever another job of this maker ends: so no policy
// can be driven into a corner. The same for the same cell, seed and calls. One thread.
class JobMaker {
 public:
  JobMaker(CellPtr cell, std::uint64_t seed);

  [[nodiscard]] const Cell& cell() const { return *cell_; }
  [[nodiscard]] std::mt19937_64& random() { return random_; }
  [[nodiscard]] double draw(double from, double to) { return uniform(random_, from, to); }

  // Joint positions with the tool down at a point of the world, or of the arm's base; nullopt: out
  // of reach.
  [[nodiscard]] std::optional<Eigen::VectorXd> tool_at(ArmId arm,
                                                       const Eigen::Vector3d& p_WT) const;
  [[nodiscard]] Eigen::Vector3d from_base(ArmId arm, const Eigen::Vector3d& p_BT) const;
  [[nodiscard]] const Eigen::VectorXd& home(ArmId arm) const { return cell_->arm(arm).home; }

  struct Draft {
    std::string kind;
    std::vector<Leg> legs;
    int priority = 0;
  };
  // Puts the jobs, each beginning where the one before ends, behind all others of the arm; or none
  // of them, when one is not open (open_places.h). Throws std::runtime_error when a draft breaks
  // limits: that is a fault of the workload.
  [[nodiscard]] bool add(ArmId arm, TimePoint at, const std::vector<Draft>& drafts);
  // The same for jobs that come home again and are known to be clear with all others at home. Where
  // one of them ends others may be shut out until the next: so that all can be done in turn,
  // take(drafts.size()). Throws std::invalid_argument where they do not come home.
  void add_trip(ArmId arm, const std::vector<Draft>& drafts);

  [[nodiscard]] const std::vector<PlannedJob>& jobs_of(ArmId arm) const {
    return jobs_[arm.index()];
  }
  // In order of submission: by time, then by turns of the arms of `each` jobs, who is first being
  // drawn.
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
