#include "core/planning/pose_descent.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace armloom {
namespace {

constexpr int kStepsMax = 100;
constexpr double kStepLongest = 0.5;  // rad or m
constexpr double kDamping = 0.1;
constexpr double kConverged = 1e-7;  // m and rad
// A search that is this far off (m and rad) and moves no joint by more than kStill (rad or m) has
// ended in a local minimum: the remaining steps cannot reach the pose.
constexpr double kFarOff = 1e-2;
constexpr double kStill = 1e-5;

using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

Eigen::Vector3d eigen(const KDL::Vector& v) { return {v.x(), v.y(), v.z()}; }

// Returns the pose of the chain's end in the world, and its velocities for each joint: linear, then
// angular. One pass over the chain; KDL's solvers take four times as long.
std::pair<KDL::Frame, Jacobian> pose_and_jacobian(const KdlChain& chain, const Eigen::VectorXd& q) {
  struct Axis {
    Eigen::Index row;
    KDL::Twist twist;    // of unit velocity, in the world
    KDL::Vector origin;  // in the world
  };
  std::vector<Axis> axes;
  axes.reserve(chain.rows.size());
  KDL::Frame end = KDL::Frame::Identity();
  for (const KDL::Segment& segment : chain.chain.segments) {
    const KDL::Joint& joint = segment.getJoint();
    double position = 0.0;
    if (joint.getType() != KDL::Joint::Fixed) {
      const Eigen::Index row = chain.rows[axes.size()];
      position = q[row];
      axes.push_back({row, end.M * joint.twist(1.0), end * joint.JointOrigin()});
    }
    end = end * segment.pose(position);
  }
  Jacobian J = Jacobian::Zero(6, q.size());
  for (const Axis& axis : axes) {
    const KDL::Vector linear = axis.twist.vel + axis.twist.rot * (end.p - axis.origin);
    J.col(axis.row).head<3>() += eigen(linear);
    J.col(axis.row).tail<3>() += eigen(axis.twist.rot);
  }
  return {end, std::move(J)};
}

}  // namespace

// Levenberg-Marquardt with damping by the error (Sugihara, "Solvability-Unconcerned Inverse
// Kinematics by the Levenberg-Marquardt Method", IEEE T-RO 2011). KDL's own solver is not used,
// because it fails an assertion of Eigen in Debian's build.
Eigen::VectorXd descend(const Cell& cell, const Arm& arm, const KdlChain& chain,
                        const Eigen::Isometry3d& X_WL, Eigen::VectorXd q) {
  const KDL::Frame there = kdl_frame(X_WL);
  for (int i = 0; i < kStepsMax; ++i) {
    const auto [here, J] = pose_and_jacobian(chain, q);
    const KDL::Twist off = KDL::diff(here, there);
    Eigen::Matrix<double, 6, 1> e;
    for (int k = 0; k < 6; ++k) e[k] = off(k);
    if (e.norm() < kConverged) break;
    const Eigen::Matrix<double, 6, 6> damped =
        J * J.transpose() +
        (0.5 * e.squaredNorm() * kDamping + 1e-9) * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::VectorXd step = J.transpose() * damped.ldlt().solve(e);
    const double longest = step.lpNorm<Eigen::Infinity>();
    if (longest > kStepLongest) step *= kStepLongest / longest;
    const Eigen::VectorXd before = q;
    q += step;
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const Joint& joint = cell.joint(arm.joints[static_cast<std::size_t>(j)]);
      q[j] = std::clamp(q[j], joint.lower, joint.upper);
    }
    if (e.norm() > kFarOff && (q - before).lpNorm<Eigen::Infinity>() < kStill) break;
  }
  return q;
}

}  // namespace armloom
