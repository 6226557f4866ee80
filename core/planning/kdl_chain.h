#pragma once

#include <kdl/chain.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/model/kinematics.h"

// Inside of core/planning: the door to Orocos KDL.
namespace armloom {

// From the world to a link: the joints of one arm on the way, all others as they stand.
struct KdlChain {
  KDL::Chain chain;
  std::vector<Eigen::Index> rows;  // of the arm's joints, by the chain's; mimic joints repeat them
};

// X_WL: of all links, at the configuration that everything else stands in. Nothing: none of the
// arm's joints moves the link.
[[nodiscard]] std::optional<KdlChain> chain_to(const Cell& cell, ArmId arm, LinkId link,
                                               const LinkPoses& X_WL);

[[nodiscard]] KDL::Frame kdl_frame(const Eigen::Isometry3d& X);

}  // namespace armloom
