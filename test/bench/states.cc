#include "test/bench/states.h"

#include <algorithm>
#include <random>

namespace armloom::bench {
namespace {

constexpr double kApart_m = 0.10;
constexpr double kNearMin_m = 0.003;
constexpr double kNearMax_m = 0.050;

// Uniform in [0, 1): the standard's distributions differ between libraries.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

void put_anywhere(const Cell& cell, const Arm& arm, std::mt19937_64& random, Configuration& q) {
  for (const JointId id : arm.joints) {
    const Joint& joint = cell.joint(id);
    q[static_cast<Eigen::Index>(id.index())] =
        joint.lower + uniform(random) * (joint.upper - joint.lower);
  }
}

}  // namespace

ExactScene::ExactScene(const CellPtr& cell)
    : scene(PlanningScene::build(cell).value()),
      checker(scene),
      every_arm(cell->arms.size(), true) {}

double ExactScene::between_arms(const Configuration& q, double horizon_m) {
  double smallest = horizon_m;
  for (const Proximity& pair : checker.closest_apart(q, horizon_m)) {
    if (pair.arm_b) smallest = std::min(smallest, pair.clearance_m);
  }
  return smallest;
}

double ExactScene::to_scene(const Configuration& q, double horizon_m) {
  double smallest = horizon_m;
  checker.near_pairs(q, horizon_m, every_arm, every_arm, near);
  for (const NearPair& pair : near) {
    if (checker.is_self(pair.pair) || checker.describe(pair).arm_b) continue;
    smallest = std::min(smallest, pair.clearance_m);
  }
  return smallest;
}

bool ExactScene::self_too_close(const Configuration& q, double clearance_m) {
  checker.near_pairs(q, clearance_m, every_arm, every_arm, near);
  return std::any_of(near.begin(), near.end(),
                     [this](const NearPair& pair) { return checker.is_self(pair.pair); });
}

bool ExactScene::in_contact(const Configuration& q) {
  return checker.first_closer_than(q, 0.0, every_arm).has_value();
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
  std::vector<bool> one(cell.arms.size(), false);
  const auto clear = [&] {
    return !exact.checker.first_closer_than(q, kNearMin_m, one) && !exact.self_too_close(q);
  };
  std::vector<Configuration> states;
  while (states.size() < count) {
    for (int round = 0; round < 3; ++round) {
      for (std::size_t i = 0; i < cell.arms.size(); ++i) {
        one.assign(one.size(), false);
        one[i] = true;
        do {
          put_anywhere(cell, cell.arms[i], random, q);
        } while (!clear());
      }
    }
    if (!referees.baseline_sees_one_arm_touch(q)) states.push_back(q);
  }
  return states;
}

}  // namespace armloom::bench
