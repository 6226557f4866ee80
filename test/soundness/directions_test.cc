// Compares the separation that the filter claims along one direction with capsules that are really
// moved.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/collision/filter/arm_kinematics.h"
#include "core/collision/filter/kernels.h"
#include "core/geometry/capsule/segment_distance.h"
#include "test/soundness/random_linkage.h"

namespace armloom::soundness {
namespace {

constexpr int kLanes = filter::kLanes;
constexpr std::size_t kMoves = 40;
constexpr double kMargin_m = 2e-6;

// An arm in eight SIMD lanes. In each lane every joint moves within its span.
class Arm {
 public:
  Arm(std::mt19937_64& random, double span_max) : linkage_(random), view_(linkage_.view()) {
    const bool drifts = random() % 2 == 0;
    for (int j = 0; j < linkage_.joints; ++j) {
      middle_.push_back(uniform(random, -3.0, 3.0));
      most_.push_back(random() % 4 == 0 ? 0.0 : uniform(random, 0.0, span_max));
      drift_.push_back(drifts ? uniform(random, -1.0, 1.0) : 0.0);
    }
    const std::size_t frames = linkage_.frames.size();
    axes_.resize(frames * 6 * kLanes);
    frames_.resize(frames * 12 * kLanes);
    capsules_.resize(linkage_.capsules.size() * 6 * kLanes);
    sweeps_.resize(linkage_.capsules.size() * filter::kSweep * kLanes);
    motion_bounds_.resize(static_cast<std::size_t>(linkage_.rows) * kLanes);
    for (const filter::Frame& frame : linkage_.frames) {
      const double m = most_[static_cast<std::size_t>(frame.joint)] * std::abs(frame.multiplier);
      spans_.insert(spans_.end(), kLanes, round_up(m));
      const auto joint = static_cast<std::size_t>(frame.joint);
      const auto drift = static_cast<float>(drift_[joint] * most_[joint] * frame.multiplier);
      drifts_.insert(drifts_.end(), kLanes, drift);
      looses_.insert(looses_.end(), kLanes,
                     round_up((1.0 - std::abs(drift_[joint])) * m + 1e-6 * std::abs(drift)));
    }
  }

  // Moves every joint within its span, mostly to an end; the first lane is at rest.
  void move(std::mt19937_64& random) {
    std::vector<double> q;
    std::array<double, kLanes> share;  // of all drifts
    for (double& s : share) s = random() % 2 == 0 ? uniform(random, -1.0, 1.0) : 1.0;
    for (std::size_t j = 0; j < middle_.size(); ++j) {
      q.push_back(middle_[j]);
      for (int lane = 1; lane < kLanes; ++lane) {
        const double end = random() % 2 == 0 ? 1.0 : -1.0;
        const double loose = (random() % 4 == 0 ? uniform(random, -1.0, 1.0) : 1.0) * end;
        q.push_back(middle_[j] + most_[j] * (share[static_cast<std::size_t>(lane)] * drift_[j] +
                                             (1.0 - std::abs(drift_[j])) * loose));
      }
    }
    const filter::Kernel& kernel = filter::best_kernel();
    const filter::Placed placed{frames_.data(), axes_.data(), capsules_.data()};
    kernel.place(view_, q.data(), placed);
    kernel.inflate(view_, placed, {spans_.data(), drifts_.data(), looses_.data()},
                   {motion_bounds_.data(), sweeps_.data()});
  }

  [[nodiscard]] const RandomLinkage& kinematics() const { return linkage_; }
  [[nodiscard]] NumberedCapsule capsule(int number) const {
    return {number, linkage_.capsules[static_cast<std::size_t>(number)]};
  }
  [[nodiscard]] filter::SweptCapsule swept(int capsule) const {
    const float* at = capsules_.data() + capsule * 6 * kLanes;
    return {at, at, sweeps_.data() + capsule * filter::kSweep * kLanes, 0, 1};
  }
  // A side of the kernels' comparisons, with its sweeps.
  [[nodiscard]] filter::Side side() const {
    return {.capsules = capsules_.data(),
            .motion_bound = motion_bounds_.data(),
            .ball = nullptr,
            .sweeps = sweeps_.data()};
  }
  [[nodiscard]] int row(int number) const { return capsule(number).capsule.motion_bounds_begin; }
  [[nodiscard]] CenteredSegment segment(int capsule, int lane) const {
    CenteredSegment segment;
    for (int i = 0; i < 3; ++i) {
      segment.center[i] = static_cast<double>(capsules_[at(capsule, i, lane)]);
      segment.half[i] = static_cast<double>(capsules_[at(capsule, i + 3, lane)]);
    }
    return segment;
  }

 private:
  [[nodiscard]] static std::size_t at(int capsule, int row, int lane) {
    return static_cast<std::size_t>((capsule * 6 + row) * kLanes + lane);
  }
  RandomLinkage linkage_;
  filter::ArmKinematics view_;
  std::vector<double> middle_, most_, frames_;
  std::vector<double> drift_;  // share of most_ by which all joints move together
  std::vector<float> axes_, capsules_, motion_bounds_, sweeps_, spans_, drifts_, looses_;
};

struct Tally {
  std::size_t pairs = 0;
  double closest = 1.0;  // smallest (distance found - claim) / (distance before moving - claim)
};

// Claims of a kernel about two capsules, or a capsule of `a` and a box, in the first lane.
class Claim {
 public:
  enum class By { parted, near_pairs, near_boxes };
  Claim(By by, const Arm& a, const Arm& b, std::mt19937_64& random)
      : by_(by),
        a_(a),
        b_(b),
        capsule_a_(static_cast<int>(random() % a.kinematics().capsules.size())),
        capsule_b_(static_cast<int>(random() % b.kinematics().capsules.size())) {
    for (double& x : half_m_) x = uniform(random, 0.0, 0.3);
    for (double& x : p_WB_) x = uniform(random, -1.0, 1.0);
    const Eigen::Vector3d axis(uniform(random, -1, 1), uniform(random, -1, 1), 0.3);
    R_WB_ = Eigen::AngleAxisd(uniform(random, -3, 3), axis.normalized()).toRotationMatrix();
  }

  [[nodiscard]] bool keeps(double limit_m) const {
    return by_ == By::near_boxes ? box_keeps(limit_m) : pair_keeps(limit_m);
  }
  [[nodiscard]] double distance_m(int lane_a, int lane_b) const {
    CenteredSegment segment = a_.segment(capsule_a_, lane_a);
    const double radius_m = a_.capsule(capsule_a_).capsule.radius_up;
    if (by_ != By::near_boxes) {
      return segment_segment_distance(segment, b_.segment(capsule_b_, lane_b)) - radius_m -
             static_cast<double>(b_.capsule(capsule_b_).capsule.radius_up);
    }
    segment.center = (R_WB_.transpose() * (segment.center - p_WB_)).eval();
    segment.half = (R_WB_.transpose() * segment.half).eval();
    return segment_box_distance(segment, half_m_) - radius_m;
  }

 private:
  [[nodiscard]] bool pair_keeps(double limit_m) const {
    filter::Pair pair =
        kernel_pair(a_.capsule(capsule_a_), b_.capsule(capsule_b_), limit_m, kMargin_m);
    const filter::Kernel& kernel = filter::best_kernel();
    if (by_ == By::parted) {
      const filter::SweptCapsule a = a_.swept(capsule_a_), b = b_.swept(capsule_b_);
      return kernel.parted(a, b, pair, hit_of(a, b, pair).direction).distance >= pair.limit_up;
    }
    pair.row_a = a_.row(capsule_a_);
    pair.row_b = b_.row(capsule_b_);
    filter::Hit hit;
    return kernel.near_pairs(a_.side(), b_.side(), {&pair, 1, {}}, 1U, &hit) == 0;
  }
  [[nodiscard]] bool box_keeps(double limit_m) const {
    filter::StaticBox box{};
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) box.R[3 * k + c] = static_cast<float>(R_WB_(c, k));
      box.center[k] = static_cast<float>(p_WB_[k]);
      box.half_up[k] = round_up(half_m_[k]);
    }
    box.ball_up = round_up(half_m_.norm() + 2.0 * kMargin_m);
    box.margin_up = static_cast<float>(kMargin_m);
    box.limit_up = round_up(limit_m);
    box.end = 1;
    const filter::Capsule& capsule = a_.capsule(capsule_a_).capsule;
    const filter::BoxedCapsule boxed{capsule_a_, a_.row(capsule_a_), capsule.radius_up,
                                     capsule.ball_up};
    filter::Hit hit;
    return filter::best_kernel().near_boxes(a_.side(), {&box, 1, &boxed}, 1U, &hit) == 0;
  }

  By by_;
  const Arm& a_;
  const Arm& b_;
  int capsule_a_, capsule_b_;
  Eigen::Vector3d half_m_, p_WB_;
  Eigen::Matrix3d R_WB_;
};

// Returns the largest limit that is claimed to be kept; -1 if none.
double largest_kept(const Claim& claim) {
  double low = 0.0, high = 4.0;
  if (!claim.keeps(low)) return -1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (claim.keeps(middle) ? low : high) = middle;
  }
  return low;
}

Tally attack(Claim::By by, double span_max, std::size_t rounds) {
  std::mt19937_64 random(47);
  Tally tally;
  for (std::size_t round = 0; round < rounds; ++round) {
    Arm a(random, span_max), b(random, span_max);
    a.move(random);
    b.move(random);
    const Claim claim(by, a, b, random);
    const double limit_m = largest_kept(claim);
    if (limit_m < 0.0) continue;
    ++tally.pairs;
    const double before_m = claim.distance_m(0, 0);
    double least_m = before_m;
    for (std::size_t i = 0; i < kMoves; ++i) {
      a.move(random);
      b.move(random);
      for (int lane = 0; lane < kLanes * kLanes; ++lane) {
        least_m = std::min(least_m, claim.distance_m(lane / kLanes, lane % kLanes));
      }
    }
    EXPECT_GE(least_m, limit_m) << "round " << round;
    const double lost_m = before_m - limit_m;
    if (lost_m > 0.01) tally.closest = std::min(tally.closest, (least_m - limit_m) / lost_m);
  }
  return tally;
}

void expect_sound_and_tight(Claim::By by) {
  const Tally small = attack(by, 0.05, 3'000);
  EXPECT_GE(small.pairs, 1'000U);
  EXPECT_LE(small.closest, 0.1);  // an attack that never comes close would prove nothing
  const Tally large = attack(by, 0.4, 3'000);
  EXPECT_GE(large.pairs, 300U);
  EXPECT_LE(large.closest, 0.4);
}

TEST(DirectionBound, IsSoundAndTight) { expect_sound_and_tight(Claim::By::parted); }
TEST(DirectionBound, OfPairsIsSoundAndTight) { expect_sound_and_tight(Claim::By::near_pairs); }
TEST(DirectionBound, OfBoxesIsSoundAndTight) { expect_sound_and_tight(Claim::By::near_boxes); }

}  // namespace
}  // namespace armloom::soundness
