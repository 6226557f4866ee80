#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"
#include "core/trajectory/validate.h"

// Inside of core/trajectory: the last stage of validate().
namespace armloom {

// Collects problems in the order found and drops what comes after the first kProblemsMax.
class ProblemList {
 public:
  void add(Problem problem) {
    if (!full()) problems_.push_back(std::move(problem));
  }
  [[nodiscard]] bool full() const { return problems_.size() >= kProblemsMax; }
  [[nodiscard]] bool empty() const { return problems_.empty(); }
  [[nodiscard]] Problems take() && { return std::move(problems_); }

 private:
  Problems problems_;
};

// Six significant digits at most: "3.41", "1e-06", "nan".
[[nodiscard]] std::string to_text(double value);

// The motion of a request whose names and shape are right: its segments, with rest and limits
// checked. `times` are those of the waypoints, ascending from zero. After the first kProblemsMax
// problems it stops; segments are complete only if `problems` stays empty.
[[nodiscard]] std::vector<Segment> checked_segments(const TrajectoryRequest& request,
                                                    const std::vector<Duration>& times,
                                                    const std::vector<JointId>& joints,
                                                    const Cell& cell, ProblemList& problems);

}  // namespace armloom
