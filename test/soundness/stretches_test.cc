// Compares the claimed separation in every stretch of a motion with capsules anywhere on their
// paths.
#include <gtest/gtest.h>

#include <algorithm>
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
constexpr double kMargin_m = 2e-6;
constexpr double kLoose = 0.001;  // rad or m: deviation of each joint from its line

// A line in joint space in eight stretches.
class Passing {
 public:
  Passing(std::mt19937_64& random, double way_max) : linkage_(random) {
    for (int j = 0; j < linkage_.joints; ++j) {
      middle_.push_back(uniform(random, -3.0, 3.0));
      way_.push_back(uniform(random, -way_max, way_max));
    }
    at_ = placed(std::vector<double>(kLanes, 0.0), nullptr);
    std::vector<double> middles;
    for (int lane = 0; lane < kLanes; ++lane) middles.push_back((2.0 * lane + 1.0) / kLanes - 1.0);
    stretches_ = placed(middles, &sweeps_);
  }
  [[nodiscard]] int random_capsule(std::mt19937_64& random) const {
    return static_cast<int>(random() % linkage_.capsules.size());
  }
  [[nodiscard]] NumberedCapsule capsule(int number) const {
    return {number, linkage_.capsules[static_cast<std::size_t>(number)]};
  }
  [[nodiscard]] filter::SweptCapsule swept(int capsule) const {
    return {at_.data() + capsule * 6 * kLanes, stretches_.data() + capsule * 6 * kLanes,
            sweeps_.data() + capsule * filter::kSweep * kLanes, 0, kLanes};
  }
  // Returns the capsule at eight random states, off the line by up to kLoose.
  [[nodiscard]] std::vector<CenteredSegment> somewhere(int capsule, std::mt19937_64& random) const {
    std::vector<double> shares;
    for (int lane = 0; lane < kLanes; ++lane) shares.push_back(uniform(random, -1.0, 1.0));
    const std::vector<float> at = placed(shares, nullptr, &random);
    std::vector<CenteredSegment> segments(kLanes);
    for (int lane = 0; lane < kLanes; ++lane) {
      for (int i = 0; i < 6; ++i) {
        const auto value =
            static_cast<double>(at[static_cast<std::size_t>((capsule * 6 + i) * kLanes + lane)]);
        CenteredSegment& segment = segments[static_cast<std::size_t>(lane)];
        (i < 3 ? segment.center : segment.half)[i % 3] = value;
      }
    }
    return segments;
  }

 private:
  [[nodiscard]] std::vector<float> placed(const std::vector<double>& shares,
                                          std::vector<float>* sweeps,
                                          std::mt19937_64* loose = nullptr) const {
    const filter::ArmKinematics view = linkage_.view();
    std::vector<double> q;
    for (std::size_t j = 0; j < middle_.size(); ++j) {
      for (const double share : shares) {
        const double off = loose == nullptr ? 0.0 : uniform(*loose, -kLoose, kLoose);
        q.push_back(middle_[j] + share * way_[j] + off);
      }
    }
    const std::size_t frames = linkage_.frames.size();
    std::vector<double> poses(frames * 12 * kLanes);
    std::vector<float> axes(frames * 6 * kLanes);
    std::vector<float> capsules(linkage_.capsules.size() * 6 * kLanes);
    const filter::Placed at{poses.data(), axes.data(), capsules.data()};
    filter::best_kernel().place(view, q.data(), at);
    if (sweeps == nullptr) return capsules;
    std::vector<float> spans, drifts, looses;
    for (const filter::Frame& frame : linkage_.frames) {
      const double drift = way_[static_cast<std::size_t>(frame.joint)] * frame.multiplier / kLanes;
      const double off = kLoose * std::abs(frame.multiplier) + 1e-6 * std::abs(drift);
      drifts.insert(drifts.end(), kLanes, static_cast<float>(drift));
      looses.insert(looses.end(), kLanes, round_up(off));
      spans.insert(spans.end(), kLanes, round_up(std::abs(drift) + off));
    }
    std::vector<float> rows(static_cast<std::size_t>(linkage_.rows) * kLanes);
    sweeps->resize(linkage_.capsules.size() * filter::kSweep * kLanes);
    filter::best_kernel().inflate(view, at, {spans.data(), drifts.data(), looses.data()},
                                  {rows.data(), sweeps->data()});
    return capsules;
  }

  RandomLinkage linkage_;
  std::vector<double> middle_, way_;
  std::vector<float> at_, stretches_, sweeps_;
};

TEST(Stretches, BoundIsSoundAndTight) {
  std::mt19937_64 random(53);
  std::size_t pairs = 0;
  double closest_m = 1.0;
  for (int round = 0; round < 3'000; ++round) {
    const Passing a(random, 0.4);
    const Passing b(random, 0.4);
    const int capsule_a = a.random_capsule(random);
    const int capsule_b = b.random_capsule(random);
    const filter::Pair pair =
        kernel_pair(a.capsule(capsule_a), b.capsule(capsule_b), 0.0, kMargin_m);
    const filter::SweptCapsule swept_a = a.swept(capsule_a), swept_b = b.swept(capsule_b);
    const auto kept_m = static_cast<double>(
        filter::best_kernel()
            .parted(swept_a, swept_b, pair, hit_of(swept_a, swept_b, pair).direction)
            .distance);
    if (kept_m < 0.0) continue;
    ++pairs;
    const auto radii_m = static_cast<double>(a.capsule(capsule_a).capsule.radius_up +
                                             b.capsule(capsule_b).capsule.radius_up);
    for (int i = 0; i < 20; ++i) {
      for (const CenteredSegment& at_a : a.somewhere(capsule_a, random)) {
        for (const CenteredSegment& at_b : b.somewhere(capsule_b, random)) {
          const double distance_m = segment_segment_distance(at_a, at_b) - radii_m;
          ASSERT_GE(distance_m, kept_m) << "round " << round;
          closest_m = std::min(closest_m, distance_m - kept_m);
        }
      }
    }
  }
  EXPECT_GE(pairs, 300U);
  EXPECT_LE(closest_m, 0.01);  // an attack that never comes close would prove nothing
}

}  // namespace
}  // namespace armloom::soundness
