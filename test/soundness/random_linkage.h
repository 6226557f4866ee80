#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/collision/filter/kernels.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {

// A random tree of revolute, prismatic and mimic joints with capsules.
struct RandomLinkage {
  explicit RandomLinkage(std::mt19937_64& random) {
    const int frame_count = 1 + static_cast<int>(random() % 9);
    joints = 1 + static_cast<int>(random() % 6);
    std::vector<std::vector<int>> chains;
    for (int f = 0; f < frame_count; ++f) {
      const int parent =
          f == 0 ? -1 : static_cast<int>(random() % static_cast<unsigned>(f + 1)) - 1;
      filter::Frame frame{.parent = parent,
                          .joint = static_cast<int>(random() % static_cast<unsigned>(joints)),
                          .prismatic = random() % 4 == 0,
                          .multiplier = random() % 3 == 0 ? uniform(random, -2.0, 2.0) : 1.0,
                          .offset = random() % 3 == 0 ? uniform(random, -3.0, 3.0) : 0.0,
                          .C = {}};
      const Eigen::Vector3d axis(uniform(random, -1, 1), uniform(random, -1, 1), 0.3);
      Eigen::Map<Eigen::Matrix<double, 3, 4>> C(frame.C);
      C.leftCols<3>() =
          Eigen::AngleAxisd(uniform(random, -3, 3), axis.normalized()).toRotationMatrix();
      for (int i = 0; i < 3; ++i) C(i, 3) = uniform(random, -0.5, 0.5);
      frames.push_back(frame);
      chains.push_back(parent < 0 ? std::vector<int>{} : chains[static_cast<std::size_t>(parent)]);
      chains.back().push_back(f);
    }
    for (int c = 0; c < 12; ++c) {
      filter::Capsule capsule{};
      capsule.frame = static_cast<int>(random() % static_cast<unsigned>(frame_count));
      for (double& x : capsule.center) x = uniform(random, -0.2, 0.2);
      const bool ball = random() % 5 == 0;
      for (double& x : capsule.half) x = ball ? 0.0 : uniform(random, -0.2, 0.2);
      capsule.radius_up = static_cast<float>(uniform(random, 0.0, 0.1));
      const double half_m = Eigen::Map<const Eigen::Vector3d>(capsule.half).norm();
      capsule.ball_up = capsule.radius_up + static_cast<float>(half_m) + 1e-6F;
      const auto& chain = chains[static_cast<std::size_t>(capsule.frame)];
      capsule.ancestors_begin = static_cast<int>(ancestors.size());
      capsule.depth = static_cast<int>(chain.size());
      capsule.motion_bounds_begin = rows;
      rows += capsule.depth + 1;
      ancestors.insert(ancestors.end(), chain.begin(), chain.end());
      capsules.push_back(capsule);
    }
  }
  [[nodiscard]] filter::ArmKinematics view() const {
    return {frames.data(), static_cast<int>(frames.size()), capsules.data(),
            static_cast<int>(capsules.size()), ancestors.data()};
  }

  int joints = 0;
  int rows = 0;
  std::vector<filter::Frame> frames;
  std::vector<filter::Capsule> capsules;
  std::vector<int> ancestors;
};

// Returns a hit of the two capsules in the first lane, as near_pairs finds it: with its direction.
inline filter::Hit hit_of(const filter::SweptCapsule& a, const filter::SweptCapsule& b,
                          filter::Pair pair) {
  const float still[filter::kLanes] = {};
  pair.a = pair.b = pair.row_a = pair.row_b = 0;
  pair.limit_up = 100.0F;  // so that the capsules are near
  filter::Hit hit;
  filter::best_kernel().near_pairs({a.at, still, nullptr}, {b.at, still, nullptr}, {&pair, 1, {}},
                                   1U, &hit);
  return hit;
}

}  // namespace armloom::soundness
