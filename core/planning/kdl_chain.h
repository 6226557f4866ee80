#pragma once

#include <kdl/chain.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/model/kinematics.h"

// Internal to core/planning: interface to Orocos KDL.
namespace armloom {

// Kinematic chain from the world to a link, in which only the joints of one arm move.
struct KdlChain {
  KDL::Chain chain;
  std::vector<Eigen::Index> rows;  // chain's joint -> arm's joint; mimic joints repeat it
};

// Returns the chain to `link`, or nullopt if no joint of the arm moves the link. X_WL contains the
// poses of all links in the current configuration.
[[nodiscard]] std::optional<KdlChain> chain_to(const Cell& cell, ArmId arm, LinkId link,
                                               const LinkPoses& X_WL);

[[nodiscard]] KDL::Frame kdl_frame(const Eigen::Isometry3d& X);

}  // namespace armloom
