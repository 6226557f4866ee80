#include "core/collision/diagram/motion_tube.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/collision/diagram/tube_scratch.h"
#include "core/collision/filter/kernels.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

using filter::kLanes;
// Generous bound of the rounding of positions and times.
constexpr double kRounding = 1e-8;

std::size_t lane_size(std::size_t rows) { return rows * static_cast<std::size_t>(kLanes); }

Eigen::Map<Eigen::Array<float, kLanes, 1>> lanes_of(float* rows, std::size_t row) {
  return Eigen::Map<Eigen::Array<float, kLanes, 1>>(rows + lane_size(row));
}
Eigen::Map<Eigen::Array<float, kLanes, 1>> lanes_of(std::vector<float>& rows, std::size_t row) {
  return lanes_of(rows.data(), row);
}

}  // namespace

MotionTube::Block::Block(const ArmKinematics& arm) {
  const std::size_t capsule_count = arm.capsules().size(), frame_count = arm.frames().size();
  const auto spread_count =
      static_cast<std::size_t>(4 * filter::spread_size(static_cast<int>(capsule_count)));
  struct Array {
    float*& of;
    std::size_t size;
  };
  const Array arrays[] = {{capsules, lane_size(6 * capsule_count)},
                          {motion_bound, lane_size(capsule_count)},
                          {ball, lane_size(4)},
                          {spread, spread_count},
                          {drifts, lane_size(frame_count)},
                          {looses, lane_size(frame_count)},
                          {sweeps, lane_size(filter::kSweep * capsule_count)}};
  std::size_t size = 0;
  for (const Array& array : arrays) size += array.size;
  frames = std::make_unique_for_overwrite<double[]>(lane_size(12 * frame_count));
  floats = std::make_unique_for_overwrite<float[]>(size);
  float* next = floats.get();
  for (const Array& array : arrays) array.of = std::exchange(next, next + array.size);
  bytes = sizeof *this + size * sizeof(float) + lane_size(12 * frame_count) * sizeof(double);
}

std::shared_ptr<MotionTube::Scratch> MotionTube::make_scratch(const ArmGeometry& geometry) {
  const ArmKinematics& arm = geometry.kinematics;
  auto s = std::make_shared<Scratch>();
  s->q.resize(lane_size(arm.joints().size()));
  for (auto* rows : {&s->joints.span, &s->joints.drift, &s->joints.loose}) {
    rows->resize(lane_size(arm.joints().size()));
  }
  s->spans.resize(lane_size(arm.frames().size()));
  s->axes.resize(lane_size(arm.frames().size() * 6));
  s->motion_bounds.resize(lane_size(static_cast<std::size_t>(arm.motion_bound_rows())));
  s->capsule_rows.resize(arm.capsules().size());
  std::iota(s->capsule_rows.begin(), s->capsule_rows.end(), 0);
  s->hits.resize(geometry.self.pairs.size() + 1);
  return s;
}

MotionTube::MotionTube(std::shared_ptr<const ArmGeometry> geometry, TrajectoryPtr trajectory,
                       const Configuration& rest, double tracking_error,
                       std::shared_ptr<Scratch> scratch)
    : TimeTree(trajectory ? trajectory->duration() : Duration{}),
      geometry_(std::move(geometry)),
      trajectory_(std::move(trajectory)),
      scratch_(scratch ? std::move(scratch) : make_scratch(*geometry_)) {
  const ArmKinematics& arm = geometry_->kinematics;
  rest_.reserve(arm.joints().size());
  for (const JointId joint : arm.joints()) {
    rest_.push_back(rest[static_cast<Eigen::Index>(joint.index())]);
  }
  find_columns(trajectory_ ? trajectory_->joints() : std::vector<JointId>{});
  shift_.assign(rest_.size(), 0.0);
  error_.assign(rest_.size(), tracking_error);
}

MotionTube::MotionTube(std::shared_ptr<const ArmGeometry> geometry, const Reach& reach,
                       std::shared_ptr<Scratch> scratch)
    : MotionTube(std::move(geometry), reach.moves() ? reach.motion : nullptr, reach.rest, 0.0,
                 std::move(scratch)) {
  TimeTree::operator=(TimeTree(reach.moves() ? reach.to - reach.from : Duration{}));
  begin_ = reach.from;
  Configuration at = reach.rest;
  if (reach.motion && !reach.moves()) {
    reach.motion->sample_positions(reach.from, scratch_->position);
    set_joints(at, *reach.motion, scratch_->position);
  }
  for (std::size_t row = 0; row < rest_.size(); ++row) {
    const auto joint = static_cast<Eigen::Index>(kinematics().joints()[row].index());
    rest_[row] = at[joint] + reach.shift[joint];
    shift_[row] = reach.shift[joint];
    error_[row] = reach.error[joint];
  }
}

void MotionTube::find_columns(const std::vector<JointId>& moved) {
  column_.clear();
  for (const JointId joint : kinematics().joints()) {
    const auto found = std::find(moved.begin(), moved.end(), joint);
    column_.push_back(found == moved.end() ? -1 : static_cast<int>(found - moved.begin()));
  }
}

void MotionTube::move_along(const std::vector<JointId>& joints, const Eigen::VectorXd& from,
                            const Eigen::VectorXd& to, Duration duration) {
  if (trajectory_ || line_from_.size() != from.size()) find_columns(joints);
  trajectory_ = nullptr;
  begin_ = Duration{};
  line_from_ = from;
  if (duration > Duration{}) {
    line_velocity_ = (to - from) / to_seconds(duration);
  } else {
    line_velocity_.setZero(from.size());
  }
  restart(duration);
  placements_.clear();
  self_hits_.clear();
  used_ = 0;
}

std::size_t MotionTube::bytes() const {
  std::size_t bytes =
      size() * (sizeof(Placement) + sizeof(Duration) * 3) + self_hits_.capacity() * sizeof(SelfHit);
  if (trajectory_) bytes += trajectory_->bytes();
  return blocks_.empty() ? bytes : bytes + blocks_.size() * blocks_.front()->bytes;
}

void MotionTube::configuration(Duration time, double* q) {
  if (trajectory_) trajectory_->sample_positions(begin_ + time, scratch_->position);
  if (line_from_.size() > 0) {
    scratch_->position = line_from_ + to_seconds(time) * line_velocity_;
  }
  for (std::size_t row = 0; row < rest_.size(); ++row) {
    q[row] = column_[row] < 0 ? rest_[row] : scratch_->position[column_[row]] + shift_[row];
  }
}

std::shared_ptr<MotionTube> MotionTube::still_at(Duration time) {
  const std::shared_ptr<MotionTube> still(new MotionTube(geometry_, Duration{}, scratch_));
  still->rest_.resize(rest_.size());
  configuration(time, still->rest_.data());
  still->column_.assign(rest_.size(), -1);
  still->shift_.assign(rest_.size(), 0.0);
  still->error_ = error_;
  return still;
}

void MotionTube::place(std::span<const int> nodes, bool with_self) {
  placements_.resize(size());
  int batch[kLanes];
  std::size_t count = 0;
  for (const int node : nodes) {
    Placement& to_place = placements_[static_cast<std::size_t>(node)];
    if (to_place.placed && (to_place.with_self || !with_self)) continue;
    to_place.placed = true;
    to_place.with_self = with_self;
    batch[count++] = node;
    if (count == kLanes) {
      place_batch({batch, count}, with_self);
      count = 0;
    }
  }
  if (count > 0) place_batch({batch, count}, with_self);
}

// Fills all lanes for nodes of a straight line, which have the same width and so the same bounds.
void MotionTube::fill_lanes_of_line(std::span<const int> nodes) {
  Scratch& s = *scratch_;
  const double half_s = 0.5 * to_seconds(width(nodes.front())) + 1e-9;
  Eigen::Array<double, kLanes, 1> time_s;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    time_s[static_cast<Eigen::Index>(lane)] =
        to_seconds(middle(nodes[std::min(lane, nodes.size() - 1)]));
  }
  for (std::size_t row = 0; row < rest_.size(); ++row) {
    const int column = column_[row];
    const double velocity = column < 0 ? 0.0 : line_velocity_[column];
    const double from = column < 0 ? rest_[row] : line_from_[column];
    const double drift = velocity * half_s;
    const double loose = error_[row] + (column < 0 ? 0.0 : kRounding + 1e-6 * std::abs(drift));
    Eigen::Map<Eigen::Array<double, kLanes, 1>>(&s.q[lane_size(row)]) = from + velocity * time_s;
    lanes_of(s.joints.span, row) = round_up(std::abs(drift) + loose);
    lanes_of(s.joints.drift, row) = static_cast<float>(drift);
    lanes_of(s.joints.loose, row) = round_up(loose);
  }
}

// Fills a lane with the configuration at the middle of the interval. Also fills in bounds of the
// joints' deviation from this configuration, and from a line through it in joint space.
void MotionTube::fill_lane(int node, int lane) {
  Scratch& s = *scratch_;
  if (trajectory_) trajectory_->enclose_about_line(begin_ + from(node), begin_ + to(node), s.line);
  // Nodes are cut at whole nanoseconds, so neither half of a node is longer than half_s.
  const double half_s = 0.5 * to_seconds(width(node)) + 1e-9;
  for (std::size_t row = 0; row < rest_.size(); ++row) {
    const std::size_t place = lane_size(row) + static_cast<std::size_t>(lane);
    const int column = column_[row];
    double loose = error_[row];
    double drift = 0.0;
    if (column < 0) {
      s.q[place] = rest_[row];
    } else {
      s.q[place] = s.line.position[column] + shift_[row];
      drift = s.line.velocity[column] * half_s;
      // Covers the rounding of a drift to float.
      loose += s.line.off[column] + kRounding + 1e-6 * std::abs(drift);
    }
    s.joints.span[place] = round_up(std::abs(drift) + loose);
    s.joints.drift[place] = static_cast<float>(drift);
    s.joints.loose[place] = round_up(loose);
  }
}

void MotionTube::fill_lanes(std::span<const int> nodes) {
  Scratch& s = *scratch_;
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto i = std::min(static_cast<std::size_t>(lane), nodes.size() - 1);
    if (i == static_cast<std::size_t>(lane)) {
      fill_lane(nodes[i], lane);
      continue;
    }
    // An unused lane repeats the last used lane.
    for (std::size_t row = 0; row < rest_.size(); ++row) {
      const std::size_t to = lane_size(row) + static_cast<std::size_t>(lane);
      s.q[to] = s.q[lane_size(row) + i];
      for (auto* rows : {&s.joints.span, &s.joints.drift, &s.joints.loose}) {
        (*rows)[to] = (*rows)[lane_size(row) + i];
      }
    }
  }
}

void MotionTube::place_batch(std::span<const int> nodes, bool with_self) {
  const ArmKinematics& arm = geometry_->kinematics;
  const filter::Kernel& kernel = filter::best_kernel();
  Scratch& s = *scratch_;
  line_from_.size() > 0 ? fill_lanes_of_line(nodes) : fill_lanes(nodes);
  if (used_ == blocks_.size()) blocks_.push_back(std::make_unique<Block>(arm));
  Block& block = *blocks_[used_++];
  for (std::size_t f = 0; f < arm.frames().size(); ++f) {
    const filter::Frame& frame = arm.frames()[f];
    const float scale = round_up(std::abs(frame.multiplier));
    const auto factor = static_cast<float>(frame.multiplier);
    const auto row = static_cast<std::size_t>(frame.joint);
    lanes_of(s.spans, f) = scale * lanes_of(s.joints.span, row) * 1.000001F;
    lanes_of(block.drifts, f) = factor * lanes_of(s.joints.drift, row);
    lanes_of(block.looses, f) = scale * lanes_of(s.joints.loose, row) * 1.000001F;
  }
  const filter::Placed placed{block.frames.get(), s.axes.data(), block.capsules};
  kernel.place(arm.view(), s.q.data(), placed);
  kernel.inflate(arm.view(), placed, {s.spans.data(), block.drifts, block.looses},
                 {s.motion_bounds.data(), block.sweeps});
  for (std::size_t c = 0; c < arm.capsules().size(); ++c) {
    const auto row = static_cast<std::size_t>(arm.capsules()[c].motion_bounds_begin);
    std::copy_n(s.motion_bounds.data() + lane_size(row), kLanes, block.motion_bound + lane_size(c));
  }
  kernel.enclose(arm.view(), block.capsules, block.motion_bound, s.capsule_rows.data(), block.ball,
                 block.spread);
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    Placement& node = placements_[static_cast<std::size_t>(nodes[lane])];
    node.block = used_ - 1;
    node.lane = lane;
  }
  if (with_self) filter_self(nodes, block);
}

// Finds the self hits of the nodes that were just placed in the block.
void MotionTube::filter_self(std::span<const int> nodes, const Block& block) {
  Scratch& s = *scratch_;
  const filter::Side side{.capsules = block.capsules,
                          .motion_bound = s.motion_bounds.data(),
                          .ball = nullptr,
                          .sweeps = block.sweeps};
  const unsigned lanes = (1U << nodes.size()) - 1U;
  const int found = filter::best_kernel().near_pairs(side, side, geometry_->self.ungrouped(), lanes,
                                                     s.hits.data());
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    Placement& node = placements_[static_cast<std::size_t>(nodes[lane])];
    node.self_begin = self_hits_.size();
    for (int h = 0; h < found; ++h) {
      const filter::Hit& hit = s.hits[static_cast<std::size_t>(h)];
      if ((hit.lanes >> lane & 1U) == 0) continue;
      self_hits_.push_back({hit.pair, hit.distance[lane], hit.motion_bound[lane]});
    }
    node.self_end = self_hits_.size();
  }
}

void MotionTube::collect_stretches(int node, std::vector<int>& stretches) {
  if (width(node) <= kStretch) {
    stretches.push_back(node);
    return;
  }
  const int child = first_child(node);
  collect_stretches(child, stretches);
  collect_stretches(child + 1, stretches);
}

MotionTube::Stretches MotionTube::stretches_of(int node) {
  if (at(node).stretches.block != nullptr || width(node) > kLanes * kStretch) {
    return at(node).stretches;
  }
  std::vector<int>& nodes = scratch_->stretches;
  nodes.clear();
  collect_stretches(node, nodes);
  placements_.resize(size());
  bool side_by_side = true;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Placement& first = at(nodes.front());
    const Placement& stretch = at(nodes[i]);
    side_by_side = side_by_side && stretch.placed && stretch.block == first.block &&
                   stretch.lane == first.lane + i;
  }
  if (!side_by_side) {
    for (const int stretch : nodes) placements_[static_cast<std::size_t>(stretch)].placed = true;
    place_batch(nodes, false);
  }
  const Placement& first = at(nodes.front());
  const int begin = static_cast<int>(first.lane);
  return placements_[static_cast<std::size_t>(node)].stretches = {
             blocks_[first.block].get(), begin, begin + static_cast<int>(nodes.size())};
}

void MotionTube::axes_of(int node, int frame, std::size_t skipped,
                         std::vector<MovingAxis>& axes) const {
  const Place place = place_of(node);
  axes.clear();
  for (const int f : kinematics().ancestors(frame).subspan(skipped)) {
    const auto at = static_cast<std::size_t>(f);
    const double* X = place.frames() + lane_size(12 * at);
    MovingAxis axis{
        .z_W = {}, .p_WO = {}, .loose = 0.0, .prismatic = kinematics().frames()[at].prismatic};
    for (int k = 0; k < 3; ++k) {
      axis.z_W[k] = X[lane_size(static_cast<std::size_t>(6 + k))];
      axis.p_WO[k] = X[lane_size(static_cast<std::size_t>(9 + k))];
    }
    axis.loose = static_cast<double>(place.block->looses[lane_size(at) + place.lane]);
    axis.drift = static_cast<double>(place.block->drifts[lane_size(at) + place.lane]);
    axes.push_back(axis);
  }
}

std::span<const MotionTube::SelfHit> MotionTube::self_hits(int index) const {
  const Placement& node = at(index);
  return {self_hits_.data() + node.self_begin, node.self_end - node.self_begin};
}

}  // namespace armloom
