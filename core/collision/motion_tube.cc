#include "core/collision/motion_tube.h"

#include <algorithm>
#include <cmath>

#include "core/collision/filter/kernels.h"

namespace armloom {
namespace {

constexpr int kLanes = filter::kLanes;
// Rounding of positions and times: far above what it can be, far below what matters.
constexpr double kRounding = 1e-8;

std::size_t lane_size(std::size_t rows) { return rows * static_cast<std::size_t>(kLanes); }

}  // namespace

struct MotionTube::Scratch {
  std::vector<double> q;
  std::vector<float> joint_span;  // [row][kLanes]
  std::vector<float> span;        // [frame][kLanes]
  std::vector<double> frames;
  std::vector<float> axes;
  std::vector<float> capsules;
  std::vector<float> suffix;
  std::vector<filter::Hit> hits;
  Eigen::VectorXd position, lower, upper;
};

MotionTube::MotionTube(std::shared_ptr<const ArmGeometry> geometry, TrajectoryPtr trajectory,
                       const Configuration& rest, double tracking_error)
    : geometry_(std::move(geometry)),
      trajectory_(std::move(trajectory)),
      tracking_error_(tracking_error),
      capsule_stride_(geometry_->linkage.capsules().size() * 8),
      frame_stride_(geometry_->linkage.frames().size() * 12),
      scratch_(std::make_shared<Scratch>()) {
  const Linkage& arm = geometry_->linkage;
  for (const JointId joint : arm.joints()) {
    rest_.push_back(rest[static_cast<Eigen::Index>(joint.index())]);
    column_.push_back(-1);
    if (!trajectory_) continue;
    const auto& moved = trajectory_->joints();
    const auto found = std::find(moved.begin(), moved.end(), joint);
    if (found != moved.end()) column_.back() = static_cast<int>(found - moved.begin());
  }
  nodes_.push_back({Duration{}, trajectory_ ? trajectory_->duration() : Duration{}});
  Scratch& s = *scratch_;
  s.q.resize(lane_size(arm.joints().size()));
  s.joint_span.resize(lane_size(arm.joints().size()));
  s.span.resize(lane_size(arm.frames().size()));
  s.frames.resize(lane_size(arm.frames().size() * 12));
  s.axes.resize(lane_size(arm.frames().size() * 6));
  s.capsules.resize(lane_size(arm.capsules().size() * 6));
  s.suffix.resize(lane_size(static_cast<std::size_t>(arm.suffix_rows())));
  s.hits.resize(geometry_->self.pairs.size() + 1);
}

int MotionTube::first_child(int index) {
  if (at(index).children < 0) {
    const Node node = at(index);
    const Duration half = node.from + (node.to - node.from) / 2;
    nodes_[static_cast<std::size_t>(index)].children = static_cast<int>(nodes_.size());
    nodes_.push_back({node.from, half});
    nodes_.push_back({half, node.to});
  }
  return at(index).children;
}

void MotionTube::configuration(Duration time, double* q) {
  if (trajectory_) trajectory_->sample_positions(time, scratch_->position);
  for (std::size_t row = 0; row < rest_.size(); ++row) {
    q[row] = column_[row] < 0 ? rest_[row] : scratch_->position[column_[row]];
  }
}

void MotionTube::place(std::span<const int> nodes) {
  int batch[kLanes];
  std::size_t count = 0;
  for (const int node : nodes) {
    Node& to_place = nodes_[static_cast<std::size_t>(node)];
    if (to_place.placed) continue;
    to_place.placed = true;
    batch[count++] = node;
    if (count == kLanes) {
      place_batch({batch, count});
      count = 0;
    }
  }
  if (count > 0) place_batch({batch, count});
}

// The configuration in the middle of the interval, and how far each joint may be from it.
void MotionTube::fill_lane(const Node& node, int lane) {
  Scratch& s = *scratch_;
  if (trajectory_) {
    trajectory_->sample_positions(node.from + (node.to - node.from) / 2, s.position);
    trajectory_->enclose_positions(node.from, node.to, s.lower, s.upper);
  }
  for (std::size_t row = 0; row < rest_.size(); ++row) {
    const std::size_t place = lane_size(row) + static_cast<std::size_t>(lane);
    const int column = column_[row];
    double span = tracking_error_;
    if (column < 0) {
      s.q[place] = rest_[row];
    } else {
      const double q = s.position[column];
      s.q[place] = q;
      span += std::max(s.upper[column] - q, q - s.lower[column]) + kRounding;
    }
    s.joint_span[place] = round_up(span);
  }
}

void MotionTube::place_batch(std::span<const int> nodes) {
  const Linkage& arm = geometry_->linkage;
  const filter::Kernel& kernel = filter::best_kernel();
  Scratch& s = *scratch_;
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto i = std::min(static_cast<std::size_t>(lane), nodes.size() - 1);
    if (i == static_cast<std::size_t>(lane)) {
      fill_lane(at(nodes[i]), lane);
      continue;
    }
    for (std::size_t row = 0; row < rest_.size(); ++row) {  // an unused lane: as the last one
      const std::size_t to = lane_size(row) + static_cast<std::size_t>(lane);
      s.q[to] = s.q[lane_size(row) + i];
      s.joint_span[to] = s.joint_span[lane_size(row) + i];
    }
  }
  for (std::size_t f = 0; f < arm.frames().size(); ++f) {
    const filter::Frame& frame = arm.frames()[f];
    const float scale = round_up(std::abs(frame.multiplier));
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto l = static_cast<std::size_t>(lane);
      s.span[lane_size(f) + l] =
          scale * s.joint_span[lane_size(static_cast<std::size_t>(frame.joint)) + l] * 1.000001F;
    }
  }
  kernel.place(arm.view(), s.q.data(), {s.frames.data(), s.axes.data(), s.capsules.data()});
  kernel.inflate(arm.view(), s.axes.data(), s.capsules.data(), s.span.data(), s.suffix.data());
  keep(nodes);
  const filter::Side side{s.capsules.data(), s.suffix.data()};
  const unsigned lanes = (1U << nodes.size()) - 1U;
  const int found =
      kernel.near_pairs(side, side, geometry_->self.pairs.data(),
                        static_cast<int>(geometry_->self.pairs.size()), lanes, s.hits.data());
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    Node& node = nodes_[static_cast<std::size_t>(nodes[lane])];
    node.self_begin = self_hits_.size();
    for (int h = 0; h < found; ++h) {
      const filter::Hit& hit = s.hits[static_cast<std::size_t>(h)];
      if ((hit.lanes >> lane & 1U) == 0) continue;
      self_hits_.push_back({hit.pair, hit.distance[lane], hit.inflation[lane]});
    }
    node.self_end = self_hits_.size();
  }
}

// From lanes to nodes.
void MotionTube::keep(std::span<const int> nodes) {
  const Linkage& arm = geometry_->linkage;
  const Scratch& s = *scratch_;
  capsules_.resize((slots_ + nodes.size()) * capsule_stride_);
  frames_.resize((slots_ + nodes.size()) * frame_stride_);
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    nodes_[static_cast<std::size_t>(nodes[lane])].slot = slots_;
    float* capsule = capsules_.data() + slots_ * capsule_stride_;
    for (std::size_t c = 0; c < arm.capsules().size(); ++c, capsule += 8) {
      const float* from = s.capsules.data() + lane_size(c * 6) + lane;
      for (std::size_t i = 0; i < 6; ++i) capsule[i] = from[lane_size(i)];
      const auto row = static_cast<std::size_t>(arm.capsules()[c].suffix_begin);
      capsule[6] = s.suffix[lane_size(row) + lane];
      capsule[7] = 0.0F;
    }
    double* frame = frames_.data() + slots_ * frame_stride_;
    const double* from = s.frames.data() + lane;
    for (std::size_t i = 0; i < frame_stride_; ++i) frame[i] = from[lane_size(i)];
    ++slots_;
  }
}

std::span<const MotionTube::SelfHit> MotionTube::self_hits(int index) const {
  const Node& node = at(index);
  return {self_hits_.data() + node.self_begin, node.self_end - node.self_begin};
}

}  // namespace armloom
