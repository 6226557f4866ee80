#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace armloom {

// A pose as files spell it: fixed-axis roll, pitch, yaw, as URDF has them.
struct PoseWords {
  Eigen::Vector3d xyz_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rpy_rad = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> rpy_deg = {};  // in its place
};

[[nodiscard]] Eigen::Isometry3d pose_of_words(const PoseWords& words);
// At a pitch of ±90° yaw is taken as zero.
[[nodiscard]] PoseWords pose_in_words(const Eigen::Isometry3d& X);

}  // namespace armloom
