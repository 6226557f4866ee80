#include "test/experiments/moves.h"

#include <algorithm>
#include <cmath>

#include "core/model/kinematics.h"

namespace armloom::experiments {
namespace {

constexpr double kShortestLine_s = 0.2;
constexpr int kPieces = 10;  // pieces of a line, like a planner's output
constexpr int kIterations = 200;
constexpr double kLimitMargin_rad = 0.05;

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Position of the tool and direction of its z axis.
class Tool {
 public:
  Tool(const Cell& cell, ArmId arm, LinkId link)
      : cell_(cell), arm_(arm), link_(link), q_(cell.home()) {}

  [[nodiscard]] Vector6 at(const Eigen::VectorXd& arm_q) {
    const std::vector<JointId>& joints = cell_.arm(arm_).joints;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      q_[static_cast<Eigen::Index>(joints[i].index())] = arm_q[static_cast<Eigen::Index>(i)];
    }
    forward_kinematics(cell_, q_, X_WL_);
    const Eigen::Isometry3d& X_WT = X_WL_[link_.index()];
    Vector6 pose;
    pose << X_WT.translation(), X_WT.linear().col(2);
    return pose;
  }

 private:
  const Cell& cell_;
  ArmId arm_;
  LinkId link_;
  Configuration q_;
  LinkPoses X_WL_;
};

bool within_limits(const Cell& cell, ArmId arm, const Eigen::VectorXd& q) {
  for (std::size_t i = 0; i < cell.arm(arm).joints.size(); ++i) {
    const Joint& joint = cell.joint(cell.arm(arm).joints[i]);
    const double value = q[static_cast<Eigen::Index>(i)];
    if (value < joint.lower + kLimitMargin_rad || value > joint.upper - kLimitMargin_rad) {
      return false;
    }
  }
  return true;
}

WaypointRequest rest_at(const Eigen::VectorXd& q, double time_s) {
  const std::vector<double> zeros(static_cast<std::size_t>(q.size()), 0.0);
  return {{q.begin(), q.end()}, zeros, zeros, time_s};
}

// Appends q0 + (q1 - q0) (10 u^3 - 15 u^4 + 6 u^5), u = t / line_s, at kPieces waypoints.
void append_line(const Eigen::VectorXd& q0, const Eigen::VectorXd& q1, double begin_s,
                 double line_s, TrajectoryRequest& request) {
  for (int k = 1; k < kPieces; ++k) {
    const double u = static_cast<double>(k) / kPieces;
    const Eigen::VectorXd dq = q1 - q0;
    const Eigen::VectorXd q = q0 + dq * (u * u * u * (10.0 + u * (-15.0 + 6.0 * u)));
    const Eigen::VectorXd v = dq * (30.0 * u * u * (1.0 + u * (-2.0 + u)) / line_s);
    const Eigen::VectorXd a = dq * (60.0 * u * (1.0 + u * (-3.0 + 2.0 * u)) / (line_s * line_s));
    request.points.push_back(
        {{q.begin(), q.end()}, {v.begin(), v.end()}, {a.begin(), a.end()}, begin_s + u * line_s});
  }
  request.points.push_back(rest_at(q1, begin_s + line_s));
}

}  // namespace

double uniform(std::mt19937_64& random, double from, double to) {
  return from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

double line_time_s(const Cell& cell, ArmId arm, const Eigen::VectorXd& from,
                   const Eigen::VectorXd& to) {
  double longest_s = kShortestLine_s;
  for (std::size_t i = 0; i < cell.arm(arm).joints.size(); ++i) {
    const Joint& joint = cell.joint(cell.arm(arm).joints[i]);
    const double dq =
        std::abs(to[static_cast<Eigen::Index>(i)] - from[static_cast<Eigen::Index>(i)]);
    // Peaks of a quintic, as in config/joint_moves.py.
    longest_s =
        std::max({longest_s, 15.0 / 8.0 * dq / (kLimitShare * joint.velocity_max),
                  std::sqrt(10.0 / std::sqrt(3.0) * dq / (kLimitShare * joint.acceleration_max))});
  }
  return longest_s;
}

double whole_10_ms(double time_s) { return std::ceil(time_s * 100.0 - 1e-6) / 100.0; }

TrajectoryRequest way(const Cell& cell, ArmId arm, const Eigen::VectorXd& start,
                      const std::vector<Leg>& legs) {
  TrajectoryRequest request;
  for (const JointId joint : cell.arm(arm).joints) {
    request.joint_names.push_back(cell.joint(joint).name);
  }
  request.points.push_back(rest_at(start, 0.0));
  double time_s = 0.0;
  const Eigen::VectorXd* from = &start;
  for (const Leg& leg : legs) {
    const double line_s = whole_10_ms(line_time_s(cell, arm, *from, leg.q) / leg.speed);
    append_line(*from, leg.q, time_s, line_s, request);
    time_s += line_s;
    if (leg.stand_s > 0.0) {
      time_s += whole_10_ms(leg.stand_s);
      request.points.push_back(rest_at(leg.q, time_s));
    }
    from = &leg.q;
  }
  return request;
}

std::optional<Eigen::VectorXd> tool_down(const Cell& cell, ArmId arm, const std::string& tool,
                                         const Eigen::Vector3d& p_WT,
                                         const Eigen::VectorXd& guess) {
  const auto link = cell.find_link(tool);
  if (!link) return std::nullopt;
  Tool pose(cell, arm, *link);
  Vector6 wanted;
  wanted << p_WT, 0.0, 0.0, -1.0;
  Eigen::VectorXd q = guess;
  Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(6, q.size());
  for (int i = 0; i < kIterations; ++i) {
    const Vector6 here = pose.at(q);
    const Vector6 error = wanted - here;
    if (error.head<3>().norm() < 1e-4 && error.tail<3>().norm() < 1e-3) {
      if (!within_limits(cell, arm, q)) return std::nullopt;
      return q;
    }
    constexpr double kStep_rad = 1e-6;
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      Eigen::VectorXd moved = q;
      moved[j] += kStep_rad;
      jacobian.col(j) = (pose.at(moved) - here) / kStep_rad;
    }
    const Eigen::Matrix<double, 6, 6> damped =
        jacobian * jacobian.transpose() + 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    const Eigen::VectorXd step = jacobian.transpose() * damped.ldlt().solve(error);
    q += step * std::min(1.0, 0.3 / std::max(step.cwiseAbs().maxCoeff(), 1e-12));
  }
  return std::nullopt;
}

}  // namespace armloom::experiments
