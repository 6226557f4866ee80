#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace armloom {

// Fixed-axis roll, pitch, yaw, as in URDF.
struct PoseWords {
  Eigen::Vector3d xyz_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy_rad = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> rpy_deg = {};  // replaces rpy_rad
};

[[nodiscard]] Eigen::Isometry3d pose_of_words(const PoseWords& words);
// Sets yaw to zero at a pitch of ±90°.
[[nodiscard]] PoseWords pose_in_words(const Eigen::Isometry3d& X);

}  // namespace armloom
