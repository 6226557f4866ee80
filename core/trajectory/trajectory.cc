#include "core/trajectory/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

namespace armloom {
namespace {

using Coefficients = Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, 6>>;

// Horner's scheme for all joints; Eigen resizes `out` if needed.
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

// Several joints are treated together, which is faster.
constexpr Eigen::Index kJointsAtOnce = 8;
using Joints = Eigen::Array<double, kJointsAtOnce, 1>;

// Replaces the coefficients of a polynomial by its six Taylor coefficients about t. T: double, or
// one value per joint.
template <class T>
void shift(std::array<T, 6>& p, double t) {
  for (std::size_t k = 0; k < 5; ++k) {
    for (std::size_t i = 5; i-- > k;) p[i] += t * p[i + 1];
  }
}

// Bounds |p(t) - p[0]| for |t| <= h.
template <class T>
T swing(const std::array<T, 6>& p, double h) {
  using std::abs;
  T sum = abs(p[5]) * h;
  for (std::size_t k = 4; k >= 1; --k) sum = (sum + abs(p[k])) * h;
  return sum;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace

SegmentBounds bounds_of(const Segment& segment, double from_s, double to_s) {
  const Eigen::Index size = segment.coefficients.rows();
  SegmentBounds bounds{Eigen::VectorXd(size), Eigen::VectorXd(size), Eigen::VectorXd(size),
                       Eigen::VectorXd(size)};
  const double h = 0.5 * (to_s - from_s);
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto c = segment.coefficients.row(j);
    std::array<double, 6> p{c[0], c[1], c[2], c[3], c[4], c[5]};
    shift(p, from_s + h);
    const double far = swing(p, h);
    bounds.lower[j] = p[0] - far;
    bounds.upper[j] = p[0] + far;
    bounds.speed[j] =
        std::abs(p[1]) + swing<double>({0.0, 2 * p[2], 3 * p[3], 4 * p[4], 5 * p[5], 0.0}, h);
    bounds.acceleration[j] =
        2 * std::abs(p[2]) + swing<double>({0.0, 6 * p[3], 12 * p[4], 20 * p[5], 0.0, 0.0}, h);
  }
  return bounds;
}

Trajectory::Trajectory(std::vector<JointId> joints, std::vector<ArmId> arms,
                       std::vector<Segment> segments, bool timed_here)
    : timed_here_(timed_here),
      joints_(std::move(joints)),
      arms_(std::move(arms)),
      duration_(Duration::zero()) {
  require(!joints_.empty(), "Trajectory: no joints");
  require(!arms_.empty(), "Trajectory: no arms");
  require(std::adjacent_find(arms_.begin(), arms_.end(), std::greater_equal<>{}) == arms_.end(),
          "Trajectory: arms must ascend, each once");
  require(!segments.empty(), "Trajectory: no segments");
  starts_.reserve(segments.size());
  coefficients_.reserve(segments.size() * joints_.size() * 6 + kJointsAtOnce);
  for (const Segment& segment : segments) {
    require(segment.start == duration_, "Trajectory: segments must be contiguous from zero");
    require(segment.duration > Duration::zero(), "Trajectory: a segment must take time");
    require(segment.coefficients.rows() == static_cast<Eigen::Index>(joints_.size()),
            "Trajectory: a segment needs one row for each joint");
    require(segment.coefficients.allFinite(), "Trajectory: a coefficient is not finite");
    starts_.push_back(segment.start);
    coefficients_.insert(coefficients_.end(), segment.coefficients.data(),
                         segment.coefficients.data() + segment.coefficients.size());
    duration_ += segment.duration;
  }
  coefficients_.insert(coefficients_.end(), kJointsAtOnce - 1, 0.0);  // for enclose_about_line()
  start_ = segments.front().coefficients.col(0);
  positions_at(segments.back().coefficients, to_seconds(segments.back().duration), goal_);
}

Trajectory::Piece Trajectory::piece(std::size_t segment) const {
  const std::size_t rows = joints_.size();
  return {coefficients_.data() + segment * rows * 6, static_cast<Eigen::Index>(rows), 6};
}

Duration Trajectory::end_of(std::size_t segment) const {
  return segment + 1 < starts_.size() ? starts_[segment + 1] : duration_;
}

Segment Trajectory::segment(std::size_t index) const {
  return {starts_[index], end_of(index) - starts_[index], piece(index)};
}

std::vector<Segment> Trajectory::segments() const {
  std::vector<Segment> segments;
  segments.reserve(segment_count());
  for (std::size_t i = 0; i < segment_count(); ++i) segments.push_back(segment(i));
  return segments;
}

std::vector<SegmentBounds> Trajectory::bounds() const {
  std::vector<SegmentBounds> bounds;
  bounds.reserve(segment_count());
  for (std::size_t i = 0; i < segment_count(); ++i) {
    bounds.push_back(bounds_of(segment(i), 0.0, to_seconds(end_of(i) - starts_[i])));
  }
  return bounds;
}

std::size_t Trajectory::bytes() const {
  return sizeof *this + coefficients_.capacity() * sizeof(double) +
         starts_.capacity() * sizeof(Duration);
}

std::size_t Trajectory::segment_at(Duration progress) const {
  // std::upper_bound without its unpredictable branch.
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
  const std::size_t at = segment_at(progress);
  const Piece segment = piece(at);
  const double t = to_seconds(progress - starts_[at]);
  positions_at(segment, t, state.position);
  velocities_at(segment, t, state.velocity);
  accelerations_at(segment, t, state.acceleration);
}

void Trajectory::sample_positions(Duration progress, Eigen::VectorXd& position) const {
  if (progress < Duration::zero()) {
    position = start_;
  } else if (progress >= duration_) {
    position = goal_;
  } else {
    const std::size_t at = segment_at(progress);
    positions_at(piece(at), to_seconds(progress - starts_[at]), position);
  }
}

void Trajectory::enclose_about_line(Duration from, Duration to, AboutLine& line) const {
  const Duration middle = from + (to - from) / 2;
  sample_positions(middle, line.position);
  line.velocity.setZero(line.position.size());
  line.off.setZero(line.position.size());
  if (from == to) return;
  const std::size_t passed = segment_at(std::min(middle, duration_ - Duration(1)));
  velocities_at(piece(passed), to_seconds(middle - starts_[passed]), line.velocity);
  const std::size_t first = segment_at(std::min(from, duration_ - Duration(1)));
  for (Eigen::Index j = 0; j < line.off.size(); j += kJointsAtOnce) {
    const Eigen::Index count = std::min(kJointsAtOnce, line.off.size() - j);
    Joints position = Joints::Zero(), velocity = Joints::Zero(), off = Joints::Zero();
    position.head(count) = line.position.segment(j, count).array();
    velocity.head(count) = line.velocity.segment(j, count).array();
    for (std::size_t i = first; i < starts_.size() && starts_[i] < to; ++i) {
      const Duration begin = std::max(from - starts_[i], Duration::zero());
      const Duration end = std::min(to, end_of(i)) - starts_[i];
      const double h = 0.5 * to_seconds(end - begin);
      const double at = to_seconds(begin) + h;  // since the segment's start
      const double ahead = to_seconds(starts_[i] - middle) + at;
      std::array<Joints, 6> p;  // joints past the end have numbers without a meaning
      const Piece segment = piece(i);
      for (std::size_t k = 0; k < 6; ++k) {
        p[k] = Eigen::Map<const Joints>(segment.col(static_cast<Eigen::Index>(k)).data() + j);
      }
      shift(p, at);
      const Joints there = (p[0] - position - velocity * ahead).abs();
      p[1] -= velocity;
      off = off.max(there + swing(p, h));
    }
    line.off.segment(j, count) = off.head(count);
  }
}

}  // namespace armloom
