#include "core/planning/kdl_chain.h"

#include <algorithm>

namespace armloom {

KDL::Frame kdl_frame(const Eigen::Isometry3d& X) {
  const Eigen::Matrix3d& R = X.linear();
  const Eigen::Vector3d p = X.translation();
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                        R(2, 2)),
          KDL::Vector(p.x(), p.y(), p.z())};
}

std::optional<KdlChain> chain_to(const Cell& cell, ArmId arm, LinkId link, const LinkPoses& X_WL) {
  const auto& joints = cell.arm(arm).joints;
  const auto row_of = [&](const Link& of) -> std::optional<Eigen::Index> {
    if (!of.driver) return std::nullopt;
    const auto found = std::ranges::find(joints, *of.driver);
    if (found == joints.end()) return std::nullopt;
    return found - joints.begin();
  };
  std::vector<LinkId> way;  // from the first link that the arm moves to `link`
  std::size_t moved = 0;
  for (std::optional<LinkId> at = link; at; at = cell.link(*at).parent) {
    way.push_back(*at);
    if (row_of(cell.link(*at))) moved = way.size();
  }
  if (moved == 0) return std::nullopt;
  way.erase(way.begin() + static_cast<std::ptrdiff_t>(moved), way.end());
  std::ranges::reverse(way);

  KdlChain result;
  const auto pose_of = [&](const std::optional<LinkId>& of) {
    return of ? X_WL[of->index()] : Eigen::Isometry3d::Identity();
  };
  // F is the frame of the last KDL segment, P the parent of the next link of `way`. Before the
  // first segment, F is the world.
  Eigen::Isometry3d X_FP = pose_of(cell.link(way.front()).parent);
  for (const LinkId id : way) {
    const Link& at = cell.link(id);
    const auto row = row_of(at);
    if (!row) {  // not moved by the chain: use its current pose in the parent
      X_FP = X_FP * (pose_of(at.parent).inverse() * X_WL[id.index()]);
      continue;
    }
    const Eigen::Isometry3d X_FJ = X_FP * at.X_PJ;
    const Eigen::Vector3d p = X_FJ.translation();
    const Eigen::Vector3d axis = X_FJ.linear() * at.axis;
    const auto type =
        at.motion == JointKind::prismatic ? KDL::Joint::TransAxis : KDL::Joint::RotAxis;
    const KDL::Joint joint(cell.joint(*at.driver).name, KDL::Vector(p.x(), p.y(), p.z()),
                           KDL::Vector(axis.x(), axis.y(), axis.z()), type, at.multiplier);
    Eigen::Isometry3d X_JL = Eigen::Isometry3d::Identity();  // pose at joint position 0
    if (at.motion == JointKind::prismatic) {
      X_JL.translation() = at.offset * at.axis;
    } else {
      X_JL.linear() = Eigen::AngleAxisd(at.offset, at.axis).toRotationMatrix();
    }
    result.chain.addSegment(KDL::Segment(at.name, joint, kdl_frame(X_FJ * X_JL)));
    result.rows.push_back(*row);
    X_FP = Eigen::Isometry3d::Identity();
  }
  if (!X_FP.isApprox(Eigen::Isometry3d::Identity(), 0.0)) {  // `link` is below the last joint
    result.chain.addSegment(
        KDL::Segment(cell.link(link).name, KDL::Joint(KDL::Joint::Fixed), kdl_frame(X_FP)));
  }
  return result;
}

}  // namespace armloom
