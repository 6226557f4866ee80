#include "test/bench/states.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/collision/state/body_distance.h"
#include "core/model/kinematics.h"

namespace armloom::bench {
namespace {

constexpr double kApart_m = 0.10;
constexpr double kNearMin_m = 0.003;
constexpr double kNearMax_m = 0.050;

// Uniform in [0, 1), equal for all standard libraries.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

void put_anywhere(const Cell& cell, const Arm& arm, std::mt19937_64& random, Configuration& q) {
  for (const JointId id : arm.joints) {
    const Joint& joint = cell.joint(id);
    q[static_cast<Eigen::Index>(id.index())] =
        joint.lower + uniform(random) * (joint.upper - joint.lower);
  }
}

// Returns the smallest distance of the selected groups, at most `horizon_m`; stops early at
// `enough_m`.
template <class Wanted>
double smallest(ExactScene& exact, const Configuration& q, double horizon_m, double enough_m,
                const Wanted& wanted) {
  const PlanningScene::Bodies& bodies = exact.scene->bodies();
  forward_kinematics(*bodies.cell, q, exact.X_WL);
  double smallest_m = horizon_m;
  for (const PairGroup& group : bodies.groups) {
    if (!wanted(group)) continue;
    for (std::size_t i = group.pairs_begin; i < group.pairs_end && smallest_m > enough_m; ++i) {
      const CollisionBody& a = bodies.bodies[bodies.pairs[i].a];
      const CollisionBody& b = bodies.bodies[bodies.pairs[i].b];
      const Eigen::Isometry3d X_WA = a.pose(exact.X_WL);
      const Eigen::Isometry3d X_WB = b.pose(exact.X_WL);
      const double centers_m = (X_WA * a.sphere.p_PC - X_WB * b.sphere.p_PC).norm();
      if (centers_m - a.sphere.radius_m - b.sphere.radius_m >= smallest_m) continue;
      smallest_m =
          std::min(smallest_m, body_distance(bodies.shapes, {a, X_WA}, {b, X_WB}, smallest_m));
    }
  }
  return smallest_m;
}

using Kind = PairGroup::Kind;
constexpr double kDeepest_m = -1e9;

template <class Wanted>
bool any_closer(ExactScene& exact, const Configuration& q, double clearance_m,
                const Wanted& wanted) {
  const PairLimits limits = PairLimits::scaled(exact.cell(), clearance_m);
  return std::ranges::any_of(exact.scene->bodies().groups, [&](const PairGroup& group) {
    if (!wanted(group)) return false;
    const double limit_m = group.limit_m(limits);
    const auto only = [&](const PairGroup& other) { return &other == &group; };
    return smallest(exact, q, limit_m, std::nextafter(limit_m, 0.0), only) < limit_m;
  });
}

}  // namespace

PlanningScenePtr holding_boxes(const PlanningScenePtr& scene) {
  std::vector<Attachment> held;
  for (std::uint32_t l = 0; l < scene->cell().links.size(); ++l) {
    if (!scene->cell().links[l].name.ends_with("panda_hand")) continue;
    Attachment box{.object = {}, .link = LinkId{l}, .X_LO = Eigen::Isometry3d::Identity()};
    box.object = {.name = "held_" + std::to_string(l), .shape = Box{{0.04, 0.04, 0.08}}};
    box.X_LO.translation().z() = 0.12;
    held.push_back(std::move(box));
  }
  return *scene->with({scene->objects(), std::move(held), scene->touch()});
}

ExactScene::ExactScene(const CellPtr& cell) : scene(PlanningScene::build(cell).value()) {}

double ExactScene::between_arms(const Configuration& q, double horizon_m) {
  return smallest(*this, q, horizon_m, kDeepest_m,
                  [](const PairGroup& group) { return group.kind == Kind::arms; });
}

double ExactScene::to_scene(const Configuration& q, double horizon_m) {
  return smallest(*this, q, horizon_m, kDeepest_m, [](const PairGroup& group) {
    return group.kind == Kind::still || group.kind == Kind::mount;
  });
}

bool ExactScene::self_too_close(const Configuration& q, double clearance_m) {
  return any_closer(*this, q, clearance_m,
                    [](const PairGroup& group) { return group.kind == Kind::self; });
}

bool ExactScene::in_contact(const Configuration& q) {
  return any_closer(*this, q, 0.0, [](const PairGroup&) { return true; });
}

bool ExactScene::too_close(const Configuration& q, ArmId arm, double clearance_m) {
  return any_closer(*this, q, clearance_m, [arm](const PairGroup& group) {
    return group.arm == arm || group.other == arm;
  });
}

bool Referees::baseline_sees_one_arm_touch(const Configuration& q) {
  const Cell& cell = exact.cell();
  return std::any_of(cell.arms.begin(), cell.arms.end(), [&](const Arm& arm) {
    Configuration alone = cell.home();
    for (const JointId id : arm.joints) {
      const auto j = static_cast<Eigen::Index>(id.index());
      alone[j] = q[j];
    }
    return moveit.in_collision(alone);
  });
}

StateClasses classed_states(Referees& referees, std::size_t count) {
  ExactScene& exact = referees.exact;
  std::mt19937_64 random(2027);
  StateClasses states;
  Configuration q = exact.cell().home();
  const auto add = [&](std::vector<Configuration>& to) {
    if (to.size() < count) to.push_back(q);
  };
  while (std::min({states.apart.size(), states.near.size(), states.touching.size()}) < count) {
    for (const Arm& arm : exact.cell().arms) put_anywhere(exact.cell(), arm, random, q);
    const double d = exact.between_arms(q, kApart_m);
    if (d <= 0.0) {
      add(states.touching);
      continue;
    }
    const bool apart = d >= kApart_m;
    const bool near = d >= kNearMin_m && d <= kNearMax_m;
    if (!apart && !near) continue;
    if ((apart ? states.apart : states.near).size() == count) continue;
    const double least_m = apart ? kApart_m : kNearMin_m;
    if (exact.to_scene(q, least_m) < least_m || exact.self_too_close(q) ||
        referees.baseline_sees_one_arm_touch(q)) {
      continue;
    }
    add(apart ? states.apart : states.near);
  }
  return states;
}

std::vector<Configuration> free_states(Referees& referees, std::size_t count) {
  ExactScene& exact = referees.exact;
  std::mt19937_64 random(2028);
  const Cell& cell = exact.cell();
  Configuration q = cell.home();
  const auto clear = [&](std::uint32_t arm) {
    return !exact.too_close(q, ArmId{arm}, kNearMin_m) && !exact.self_too_close(q);
  };
  std::vector<Configuration> states;
  while (states.size() < count) {
    for (int round = 0; round < 3; ++round) {
      for (std::uint32_t i = 0; i < cell.arms.size(); ++i) {
        do {
          put_anywhere(cell, cell.arms[i], random, q);
        } while (!clear(i));
      }
    }
    if (!referees.baseline_sees_one_arm_touch(q)) states.push_back(q);
  }
  return states;
}

}  // namespace armloom::bench
