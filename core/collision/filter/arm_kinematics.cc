#include "core/collision/filter/arm_kinematics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/collision/scene/arm_reach.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/model/kinematics.h"

namespace armloom {
namespace {

// Returns a rotation that takes z to the axis.
Eigen::Matrix3d z_to(const Eigen::Vector3d& axis) {
  if (axis == Eigen::Vector3d::UnitZ()) return Eigen::Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
}

// Replaces a number within 1e-14 of an integer by the integer. This removes the rounding of right
// angles, such as 6e-17 or 1 - 1e-16.
double without_dust(double x) {
  const double whole = std::round(x);
  return std::abs(x - whole) < 1e-14 ? whole : x;
}

}  // namespace

float round_up(double x) {
  const auto rounded = static_cast<float>(x);
  if (static_cast<double>(rounded) >= x) return rounded;
  // std::nextafter(rounded, infinity), which is slow.
  const auto bits = std::bit_cast<std::uint32_t>(rounded);
  return std::bit_cast<float>(rounded < 0.0F ? bits - 1 : (bits & 0x7FFFFFFFU) + 1);
}

ArmKinematics::ArmKinematics(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm)
    : arm_(arm) {
  const Cell& cell = *bodies.cell;
  std::vector<int> seen(cell.links.size(), 0);
  std::vector<Carried> carried(cell.links.size());
  LinkPoses X_WL;
  if (!arm) forward_kinematics(cell, cell.home(), X_WL);
  for (std::size_t body = 0; body < bodies.bodies.size(); ++body) {
    const CollisionBody& own = bodies.bodies[body];
    if (own.arm != arm) continue;
    add_body(bodies, body,
             arm ? carry(cell, *own.carrier, seen, carried) : Carried{.X_FL = own.pose(X_WL)});
  }
  for (filter::Capsule& capsule : capsules_) {
    if (arm) {
      const auto frame = static_cast<std::size_t>(capsule.frame);
      capsule.ancestors_begin = ancestors_begin_[frame];
      capsule.depth = depth_[frame];
    }
    capsule.motion_bounds_begin = motion_bound_rows_;
    motion_bound_rows_ += capsule.depth + 1;
  }
}

ArmKinematics::Carried ArmKinematics::carry(const Cell& cell, LinkId id, std::vector<int>& seen,
                                            std::vector<Carried>& carried) {
  if (seen[id.index()] != 0) return carried[id.index()];
  const Link& link = cell.link(id);
  const Carried parent = link.parent ? carry(cell, *link.parent, seen, carried) : Carried{};
  const Eigen::Isometry3d X_FJ = parent.X_FL * link.X_PJ;
  Carried here{parent.frame, X_FJ,
               parent.reach_m + link.X_PJ.translation().norm() + travel_m(cell, link)};
  if (link.driver) {
    const Eigen::Matrix3d R = z_to(link.axis);
    auto row = std::find(joints_.begin(), joints_.end(), *link.driver);
    if (row == joints_.end()) row = joints_.insert(row, *link.driver);
    filter::Frame frame{.parent = parent.frame,
                        .joint = static_cast<int>(row - joints_.begin()),
                        .prismatic = link.motion == JointKind::prismatic,
                        .about_x = false,
                        .multiplier = link.multiplier,
                        .offset = link.offset,
                        .C = {}};
    Eigen::Map<Eigen::Matrix<double, 3, 4>> C(frame.C);
    C.leftCols<3>() = X_FJ.linear() * R;
    C.col(3) = X_FJ.translation();
    C = C.unaryExpr([](double x) { return without_dust(x); });
    frame.about_x = C.col(0) == Eigen::Vector3d::UnitX();
    here.frame = static_cast<int>(frames_.size());
    here.X_FL = Eigen::Isometry3d::Identity();
    here.X_FL.linear() = R.transpose();
    const auto begin = static_cast<int>(ancestors_.size());
    int depth = 1;
    if (parent.frame >= 0) {
      const auto from = static_cast<std::size_t>(parent.frame);
      depth += depth_[from];
      for (int k = 0; k < depth_[from]; ++k) {
        ancestors_.push_back(ancestors_[static_cast<std::size_t>(ancestors_begin_[from] + k)]);
      }
    }
    ancestors_.push_back(here.frame);
    ancestors_begin_.push_back(begin);
    depth_.push_back(depth);
    frames_.push_back(frame);
  }
  extent_m_ = std::max(extent_m_, here.reach_m);
  seen[id.index()] = 1;
  return carried[id.index()] = here;
}

void ArmKinematics::add_body(const PlanningScene::Bodies& bodies, std::size_t index,
                             const Carried& carried) {
  const CollisionBody& body = bodies.bodies[index];
  KinematicBody added{.body = index,
                      .frame = carried.frame,
                      .X_FP = body.held() ? carried.X_FL * body.X_CP : carried.X_FL,
                      .capsules_begin = static_cast<int>(capsules_.size()),
                      .capsules_end = 0};
  for (const LinkCapsule& capsule : body.fitted.capsules) {
    filter::Capsule c = kernel_capsule(added.X_FP, capsule.p_PA, capsule.p_PB, capsule.radius_m);
    c.frame = carried.frame;
    capsules_.push_back(c);
    const auto from_link = [&body](const Eigen::Vector3d& p_P) {
      return body.held() ? (body.X_CP * p_P).norm() : p_P.norm();
    };
    const double far =
        std::max(from_link(capsule.p_PA), from_link(capsule.p_PB)) + capsule.radius_m;
    extent_m_ = std::max(extent_m_, carried.reach_m + far);
  }
  added.capsules_end = static_cast<int>(capsules_.size());
  bodies_.push_back(added);
}

filter::ArmKinematics ArmKinematics::view() const {
  return {frames_.data(), static_cast<int>(frames_.size()), capsules_.data(),
          static_cast<int>(capsules_.size()), ancestors_.data()};
}

std::span<const int> ArmKinematics::ancestors(int frame) const {
  if (frame < 0) return {};
  const auto f = static_cast<std::size_t>(frame);
  return {ancestors_.data() + ancestors_begin_[f], static_cast<std::size_t>(depth_[f])};
}

int ArmKinematics::common_ancestors(int capsule_a, int capsule_b) const {
  const filter::Capsule& a = capsules_[static_cast<std::size_t>(capsule_a)];
  const filter::Capsule& b = capsules_[static_cast<std::size_t>(capsule_b)];
  const int* of_a = ancestors_.data() + a.ancestors_begin;
  const int* of_b = ancestors_.data() + b.ancestors_begin;
  const int least = std::min(a.depth, b.depth);
  return static_cast<int>(std::mismatch(of_a, of_a + least, of_b).first - of_a);
}

void place_frames(const ArmKinematics& kinematics, const double* q, double* frames) {
  using Columns = Eigen::Map<Eigen::Matrix<double, 3, 4>>;
  using ConstColumns = Eigen::Map<const Eigen::Matrix<double, 3, 4>>;
  for (std::size_t f = 0; f < kinematics.frames().size(); ++f) {
    const filter::Frame& frame = kinematics.frames()[f];
    Columns X(frames + 12 * f);
    const ConstColumns C(frame.C);
    if (frame.parent < 0) {
      X = C;
    } else {
      const ConstColumns parent(frames + 12 * frame.parent);
      X.noalias() = parent.leftCols<3>() * C;
      X.col(3) += parent.col(3);
    }
    const double value = frame.multiplier * q[frame.joint] + frame.offset;
    if (frame.prismatic) {
      X.col(3) += X.col(2) * value;
    } else {
      const double s = std::sin(value);
      const double c = std::cos(value);
      const Eigen::Vector3d x = X.col(0);
      X.col(0) = x * c + X.col(1) * s;
      X.col(1) = X.col(1) * c - x * s;
    }
  }
}

Eigen::Isometry3d body_pose(const KinematicBody& body, const double* frames, int stride) {
  if (body.frame < 0) return body.X_FP;
  Eigen::Isometry3d X_WF = Eigen::Isometry3d::Identity();
  const double* from = frames + 12 * stride * body.frame;
  for (int i = 0; i < 9; ++i) X_WF.linear()(i % 3, i / 3) = from[i * stride];
  for (int i = 0; i < 3; ++i) X_WF.translation()[i] = from[(9 + i) * stride];
  return X_WF * body.X_FP;
}

filter::Capsule kernel_capsule(const Eigen::Isometry3d& X_FP, const Eigen::Vector3d& p_PA,
                               const Eigen::Vector3d& p_PB, double radius_m) {
  filter::Capsule capsule{};
  capsule.frame = -1;
  const Eigen::Vector3d center = X_FP * Eigen::Vector3d(0.5 * (p_PA + p_PB));
  const Eigen::Vector3d half = X_FP.linear() * (0.5 * (p_PB - p_PA));
  for (int i = 0; i < 3; ++i) {
    capsule.center[i] = without_dust(center[i]);
    capsule.half[i] = without_dust(half[i]);
  }
  capsule.radius_up = round_up(radius_m);
  capsule.ball_up = round_up(radius_m + 0.5 * (p_PB - p_PA).norm() + 1e-6);
  return capsule;
}

filter::Pair kernel_pair(const NumberedCapsule& a, const NumberedCapsule& b, double limit_m,
                         double margin_m) {
  const double half_a = Eigen::Map<const Eigen::Vector3d>(a.capsule.half).norm();
  const double half_b = Eigen::Map<const Eigen::Vector3d>(b.capsule.half).norm();
  const auto inverse = [](double half) {
    return half > 1e-9 ? static_cast<float>(1.0 / (half * half)) : 0.0F;
  };
  return {.a = a.number,
          .b = b.number,
          .row_a = a.number,
          .row_b = b.number,
          .limit_up = round_up(limit_m),
          .radii_up =
              round_up(static_cast<double>(a.capsule.radius_up) + b.capsule.radius_up + margin_m),
          .ends_up = round_up(half_a + half_b + 1e-6),
          .end_b_up = round_up(half_b + 1e-5),
          .aa = static_cast<float>(half_a * half_a),
          .bb = static_cast<float>(half_b * half_b),
          .inv_aa = inverse(half_a),
          .inv_bb = inverse(half_b)};
}

}  // namespace armloom
