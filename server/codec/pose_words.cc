#include "server/codec/pose_words.h"

#include <cmath>

namespace armloom {

Eigen::Isometry3d pose_of_words(const PoseWords& words) {
  const Eigen::Vector3d rpy_rad =
      words.rpy_deg ? Eigen::Vector3d(*words.rpy_deg * (EIGEN_PI / 180.0)) : words.rpy_rad;
  const auto about = [&](int axis) {
    return Eigen::AngleAxisd(rpy_rad[axis], Eigen::Vector3d::Unit(axis));
  };
  return Eigen::Translation3d(words.xyz_m) * about(2) * about(1) * about(0);
}

PoseWords pose_in_words(const Eigen::Isometry3d& X) {
  const Eigen::Matrix3d R = X.linear();
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cos_pitch);
  if (cos_pitch < 1e-9) return {X.translation(), {std::atan2(-R(1, 2), R(1, 1)), pitch, 0.0}};
  return {X.translation(), {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))}};
}

}  // namespace armloom
