#include "core/trajectory/trajectory.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 6>;

// Horner for all joints in one pass; `out` has the right size or is resized by Eigen.
void positions_at(const Coefficients& c, double t, Eigen::VectorXd& out) {
  out.noalias() =
      ((((c.col(5) * t + c.col(4)) * t + c.col(3)) * t + c.col(2)) * t + c.col(1)) * t + c.col(0);
}

void velocities_at(const Coefficients& c, double t, Eigen::VectorXd& out) {
  out.noalias() =
      (((5.0 * c.col(5) * t + 4.0 * c.col(4)) * t + 3.0 * c.col(3)) * t + 2.0 * c.col(2)) * t +
      c.col(1);
}

void accelerations_at(const Coefficients& c, double t, Eigen::VectorXd& out) {
  out.noalias() =
      ((20.0 * c.col(5) * t + 12.0 * c.col(4)) * t + 6.0 * c.col(3)) * t + 2.0 * c.col(2);
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace

Trajectory::Trajectory(std::vector<JointId> joints, std::vector<ArmId> arms,
                       std::vector<Segment> segments)
    : joints_(std::move(joints)),
      arms_(std::move(arms)),
      segments_(std::move(segments)),
      duration_(Duration::zero()) {
  require(!joints_.empty(), "Trajectory: no joints");
  require(!arms_.empty(), "Trajectory: no arms");
  require(std::adjacent_find(arms_.begin(), arms_.end(), std::greater_equal<>{}) == arms_.end(),
          "Trajectory: arms must ascend, each once");
  require(!segments_.empty(), "Trajectory: no segments");
  starts_.reserve(segments_.size());
  for (const Segment& segment : segments_) {
    require(segment.start == duration_, "Trajectory: segments must be contiguous from zero");
    require(segment.duration > Duration::zero(), "Trajectory: a segment must take time");
    require(segment.coefficients.rows() == static_cast<Eigen::Index>(joints_.size()),
            "Trajectory: a segment needs one row for each joint");
    require(segment.coefficients.allFinite(), "Trajectory: a coefficient is not finite");
    starts_.push_back(segment.start);
    duration_ += segment.duration;
  }
  start_ = segments_.front().coefficients.col(0);
  positions_at(segments_.back().coefficients, to_seconds(segments_.back().duration), goal_);
}

std::size_t Trajectory::segment_at(Duration progress) const {
  // std::upper_bound with the branch replaced by arithmetic: which half it is, is unpredictable.
  const Duration* first = starts_.data();
  std::size_t count = starts_.size();
  while (count > 1) {
    const std::size_t half = count / 2;
    first = first[half] <= progress ? first + half : first;
    count -= half;
  }
  return static_cast<std::size_t>(first - starts_.data());
}

void Trajectory::sample(Duration progress, JointState& state) const {
  if (progress < Duration::zero() || progress >= duration_) {
    state.position = progress < Duration::zero() ? start_ : goal_;
    state.velocity.setZero(state.position.size());
    state.acceleration.setZero(state.position.size());
    return;
  }
  const Segment& segment = segments_[segment_at(progress)];
  const double t = to_seconds(progress - segment.start);
  positions_at(segment.coefficients, t, state.position);
  velocities_at(segment.coefficients, t, state.velocity);
  accelerations_at(segment.coefficients, t, state.acceleration);
}

void Trajectory::sample_positions(Duration progress, Eigen::VectorXd& position) const {
  if (progress < Duration::zero()) {
    position = start_;
  } else if (progress >= duration_) {
    position = goal_;
  } else {
    const Segment& segment = segments_[segment_at(progress)];
    positions_at(segment.coefficients, to_seconds(progress - segment.start), position);
  }
}

}  // namespace armloom
