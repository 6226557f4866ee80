#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/model/cell.h"
#include "core/trajectory/trajectory.h"
#include "core/trajectory/validate.h"

// Internal to core/trajectory: the last stage of validate().
namespace armloom {

// Collects the first kProblemsMax problems in the order found.
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

// Formats with at most six significant digits: "3.41", "1e-06", "nan".
[[nodiscard]] std::string to_text(double value);

// Returns the segments of a request, and checks rest at both ends and limits. Precondition: the
// request's names and shape are valid; `times` are the times of the waypoints, ascending from zero.
// The segments are complete only if `problems` stays empty.
struct CheckedSegments {
  std::vector<Segment> segments;
  // The factor by which the motion is too fast for the limits of velocity and acceleration; at most
  // 1 if the motion keeps these limits.
  double too_fast = 0.0;
};
[[nodiscard]] CheckedSegments checked_segments(const TrajectoryRequest& request,
                                               const std::vector<Duration>& times,
                                               const std::vector<JointId>& joints, const Cell& cell,
                                               ProblemList& problems);

}  // namespace armloom
