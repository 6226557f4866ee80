#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "test/trajectory/random_spline.h"
#include "test/trajectory/test_cell.h"

namespace armloom::testing {

using Points = std::vector<Eigen::VectorXd>;

inline Eigen::VectorXd random_posture(std::mt19937_64& random, const Cell& cell,
                                      const std::vector<JointId>& joints, double share = 0.8) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = cell.joint(joints[j]);
    const double middle = 0.5 * (joint.lower + joint.upper);
    const double half = 0.5 * share * (joint.upper - joint.lower);
    q[static_cast<Eigen::Index>(j)] = uniform(random, middle - half, middle + half);
  }
  return q;
}

// Returns points of smooth curves: a sum of sines per joint.
inline Points curve(std::mt19937_64& random, const Cell& cell, const std::vector<JointId>& joints,
                    std::size_t count) {
  const Eigen::VectorXd middle = random_posture(random, cell, joints, 0.2);
  Points points(count, middle);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = cell.joint(joints[j]);
    for (int wave = 1; wave <= 4; ++wave) {
      const double height = 0.3 * (joint.upper - joint.lower) / 2.0 / wave;
      const double size = uniform(random, -height, height);
      const double phase = uniform(random, 0.0, 6.28);
      for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(count - 1);
        points[i][static_cast<Eigen::Index>(j)] += size * std::sin(3.1416 * wave * x + phase);
      }
    }
  }
  return points;
}

// Returns points with steps that change direction at random.
inline Points wander(std::mt19937_64& random, const Cell& cell, const std::vector<JointId>& joints,
                     std::size_t count) {
  Points points{random_posture(random, cell, joints, 0.1)};
  Eigen::VectorXd step = Eigen::VectorXd::Zero(points.front().size());
  while (points.size() < count) {
    for (double& x : step) x = 0.7 * x + uniform(random, -0.02, 0.02);
    points.push_back(points.back() + step);
  }
  return points;
}

}  // namespace armloom::testing
