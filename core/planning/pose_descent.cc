#include "core/planning/pose_descent.h"

#include <algorithm>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

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

}  // namespace

// Levenberg-Marquardt with damping by the error (Sugihara, "Solvability-Unconcerned Inverse
// Kinematics by the Levenberg-Marquardt Method", IEEE T-RO 2011). KDL's own solver is not used,
// because it fails an assertion of Eigen in Debian's build.
Eigen::VectorXd descend(const Cell& cell, const Arm& arm, const KdlChain& chain,
                        const Eigen::Isometry3d& X_WL, Eigen::VectorXd q) {
  KDL::ChainFkSolverPos_recursive fk(chain.chain);
  KDL::ChainJntToJacSolver jacobian(chain.chain);
  const auto size = static_cast<unsigned>(chain.rows.size());
  KDL::JntArray at(size);
  KDL::Jacobian J(size);
  KDL::Frame here;
  const KDL::Frame there = kdl_frame(X_WL);
  for (int i = 0; i < kStepsMax; ++i) {
    for (unsigned j = 0; j < size; ++j) at(j) = q[chain.rows[j]];
    fk.JntToCart(at, here);
    const KDL::Twist off = KDL::diff(here, there);
    Eigen::Matrix<double, 6, 1> e;
    for (int k = 0; k < 6; ++k) e[k] = off(k);
    if (e.norm() < kConverged) break;
    jacobian.JntToJac(at, J);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, q.size());
    for (unsigned j = 0; j < size; ++j) A.col(chain.rows[j]) += J.data.col(j);
    const Eigen::Matrix<double, 6, 6> damped =
        A * A.transpose() +
        (0.5 * e.squaredNorm() * kDamping + 1e-9) * Eigen::Matrix<double, 6, 6>::Identity();
    Eigen::VectorXd step = A.transpose() * damped.ldlt().solve(e);
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
