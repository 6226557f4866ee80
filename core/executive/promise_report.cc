#include "core/executive/promise_report.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/collision/check/line_checker.h"
#include "core/collision/scene/arm_reach.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/model/kinematics.h"
#include "core/model/promises.h"

namespace armloom {
namespace {

using Distance = PromiseReport::Distance;

// Distance by which a unit of one joint's motion moves a body's farthest point, by joint.
using Levers = std::map<JointId, Distance>;

// Returns the distance of the body's farthest point from the joint's axis. `X_WJ`: the joint frame.
double far_from_axis(const CollisionBody& body, const LinkPoses& X_WL, const Link& link,
                     const Eigen::Isometry3d& X_WJ) {
  const Eigen::Vector3d axis = X_WJ.linear() * link.axis;
  double far_m = 0.0;
  for (const LinkCapsule& capsule : body.fitted.capsules) {
    for (const Eigen::Vector3d& p : {capsule.p_PA, capsule.p_PB}) {
      const Eigen::Vector3d from_axis = body.pose(X_WL) * p - X_WJ.translation();
      far_m = std::max(far_m, axis.cross(from_axis).norm() + capsule.radius_m);
    }
  }
  return far_m;
}

// Returns the distance of the body's farthest point from the origin of its carrier.
double far_from_carrier(const CollisionBody& body) {
  double far_m = 0.0;
  for (const LinkCapsule& capsule : body.fitted.capsules) {
    for (const Eigen::Vector3d& p : {capsule.p_PA, capsule.p_PB}) {
      far_m = std::max(far_m, (body.X_CP * p).norm() + capsule.radius_m);
    }
  }
  return far_m;
}

Levers levers_of(const Cell& cell, const CollisionBody& body, const LinkPoses& X_WL) {
  Levers levers;
  double way_m = far_from_carrier(body);
  for (auto id = body.carrier; id; id = cell.link(*id).parent) {
    const Link& link = cell.link(*id);
    const Eigen::Isometry3d X_WP =
        link.parent ? X_WL[link.parent->index()] : Eigen::Isometry3d::Identity();
    if (link.driver) {
      const bool slides = link.motion == JointKind::prismatic;
      const double times = std::abs(link.multiplier);
      Distance& lever = levers[*link.driver];
      lever.home_m += times * (slides ? 1.0 : far_from_axis(body, X_WL, link, X_WP * link.X_PJ));
      lever.max_m += times * (slides ? 1.0 : way_m);
    }
    way_m += travel_m(cell, link) + link.X_PJ.translation().norm();
  }
  return levers;
}

void raise(Distance& to, const Distance& by) {
  to.home_m = std::max(to.home_m, by.home_m);
  to.max_m = std::max(to.max_m, by.max_m);
}

PromiseReport report_of(const PlanningScene& scene, ArmId id, const LinkPoses& X_WL) {
  const Cell& cell = scene.cell();
  const Arm& arm = cell.arm(id);
  const Promises promises = promises_of(cell, {&id, 1});
  const double reaction_s = to_seconds(promises.reaction);
  PromiseReport report{.arm = id, .tracking_error = cell.tracking_error(arm.robot)};
  for (const std::size_t index : scene.bodies().bodies_of_arm[id.index()]) {
    Distance inflation;
    for (const auto& [joint, lever] : levers_of(cell, scene.bodies().bodies[index], X_WL)) {
      inflation.home_m += report.tracking_error * lever.home_m;
      inflation.max_m += report.tracking_error * lever.max_m;
      const Joint& limits = cell.joint(joint);
      const double braking_s = limits.velocity_max / limits.brake;
      const double moves = limits.velocity_max * (reaction_s + 0.5 * braking_s);
      raise(report.stopping, {moves * lever.home_m, moves * lever.max_m});
      const double before = limits.velocity_max * reaction_s;
      raise(report.reaction, {before * lever.home_m, before * lever.max_m});
      report.stopping_s = std::max(report.stopping_s, reaction_s + braking_s);
    }
    raise(report.inflation, inflation);
  }
  report.horizon = cell.monitor.reaction + promises.free_run();
  report.lead = promises.out_of_step() + promises.until_told();
  return report;
}

}  // namespace

Result<std::vector<PromiseReport>> report_promises(const CellPtr& cell) {
  const auto scene = PlanningScene::build(cell);
  if (!scene) return failure(scene.error());
  LinkPoses X_WL;
  forward_kinematics(*cell, cell->home(), X_WL);
  const TrackingErrors errors(*cell);
  std::vector<PromiseReport> reports;
  for (std::uint32_t a = 0; a < cell->arms.size(); ++a) {
    const ArmId arm{a};
    PromiseReport& report = reports.emplace_back(report_of(**scene, arm, X_WL));
    const auto home = LineChecker(*scene, arm, cell->home(), errors).state(cell->arm(arm).home);
    if (home.kind != LineChecker::Kind::free) report.too_close_at_home = home.proximity;
  }
  return reports;
}

}  // namespace armloom
