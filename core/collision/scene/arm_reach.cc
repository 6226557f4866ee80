#include "core/collision/scene/arm_reach.h"

#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

// Larger than the distance by which tracking errors and rounding can move a link.
constexpr double kSlack_m = 0.05;

class Chain {
 public:
  explicit Chain(const Cell& cell) : cell_(cell) {}

  // Returns the origin of the first movable joint between the world and the link (world, m).
  [[nodiscard]] Eigen::Vector3d root(LinkId id) const {
    Eigen::Isometry3d X_WL = Eigen::Isometry3d::Identity();
    std::vector<LinkId> from_root;
    for (auto next = std::optional(id); next; next = cell_.link(*next).parent) {
      from_root.push_back(*next);
    }
    for (auto next = from_root.rbegin(); next != from_root.rend(); ++next) {
      X_WL = X_WL * cell_.link(*next).X_PJ;
      if (cell_.link(*next).driver) break;
    }
    return X_WL.translation();
  }

  // Returns an upper bound of the distance between the link's origin and `center` (world, m).
  [[nodiscard]] double farthest_m(LinkId id, const Eigen::Vector3d& center) const {
    double way_m = 0.0;
    for (auto next = std::optional(id); next; next = cell_.link(*next).parent) {
      const Link& link = cell_.link(*next);
      way_m += travel_m(cell_, link);
      if (!moves(link.parent)) return way_m + (root(*next) - center).norm();
      way_m += link.X_PJ.translation().norm();
    }
    return way_m;
  }

 private:
  [[nodiscard]] bool moves(std::optional<LinkId> id) const {
    for (; id; id = cell_.link(*id).parent) {
      if (cell_.link(*id).driver) return true;
    }
    return false;
  }

  const Cell& cell_;
};

// Returns by how much the tracking errors of the arm's prismatic joints exceed its share of the
// slack (m).
double beyond_slack_m(const Cell& cell, ArmId arm) {
  double slides_m = 0.0;
  for (const Link& link : cell.links) {
    if (link.arm != arm || !link.driver || link.motion != JointKind::prismatic) continue;
    slides_m += std::abs(link.multiplier) * cell.tracking_error(link.robot);
  }
  return std::max(0.0, slides_m - 0.5 * kSlack_m);
}

}  // namespace

double travel_m(const Cell& cell, const Link& link) {
  if (link.motion != JointKind::prismatic) return 0.0;
  const Joint& joint = cell.joint(*link.driver);
  const double farthest = std::max(std::abs(joint.lower), std::abs(joint.upper));
  return std::abs(link.multiplier) * farthest + std::abs(link.offset);
}

Ball reach_of(const PlanningScene::Bodies& bodies, ArmId arm) {
  const Chain chain(*bodies.cell);
  const std::vector<std::size_t>& own = bodies.bodies_of_arm[arm.index()];
  if (own.empty()) return {Eigen::Vector3d::Zero(), 0.0};
  Ball reach{chain.root(*bodies.bodies[own.front()].carrier), 0.0};
  for (const std::size_t index : own) {
    const CollisionBody& body = bodies.bodies[index];
    double from_link_m = 0.0;
    for (const LinkCapsule& capsule : body.fitted.capsules) {
      for (const Eigen::Vector3d& p : {capsule.p_PA, capsule.p_PB}) {
        from_link_m = std::max(from_link_m, (body.X_CP * p).norm() + capsule.radius_m);
      }
    }
    reach.radius_m =
        std::max(reach.radius_m, chain.farthest_m(*body.carrier, reach.center) + from_link_m);
  }
  reach.radius_m += beyond_slack_m(*bodies.cell, arm);
  return reach;
}

bool out_of_reach(const Ball& one, const Ball& other, double clearance_m) {
  return (one.center - other.center).norm() >
         one.radius_m + other.radius_m + clearance_m + kSlack_m;
}

}  // namespace armloom
