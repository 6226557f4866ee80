#pragma once

#include <kdl/chain.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/model/kinematics.h"

// Internal to core/planning: interface to Orocos KDL.
namespace armloom {

// From the world to a link: joints of one arm move, all others are fixed.
struct KdlChain {
  KDL::Chain chain;
  std::vector<Eigen::Index> rows;  // of the arm's joints, by the chain's; mimic joints repeat them
};

// X_WL: poses of all links in the current configuration. Returns nullopt if no joint of the arm
// moves the link.
[[nodiscard]] std::optional<KdlChain> chain_to(const Cell& cell, ArmId arm, LinkId link,
                                               const LinkPoses& X_WL);

[[nodiscard]] KDL::Frame kdl_frame(const Eigen::Isometry3d& X);

}  // namespace armloom
