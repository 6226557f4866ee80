#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace armloom {

// A pose as in URDF: position, and roll, pitch, yaw about fixed axes.
struct PoseWords {
  Eigen::Vector3d xyz_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy_rad = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> rpy_deg = {};  // replaces rpy_rad
};

[[nodiscard]] Eigen::Isometry3d pose_of_words(const PoseWords& words);
// Returns yaw zero at a pitch of ±90°, where roll and yaw are not unique.
[[nodiscard]] PoseWords pose_in_words(const Eigen::Isometry3d& X);

}  // namespace armloom
