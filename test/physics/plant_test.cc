#include "server/physics/plant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <numbers>

#include "core/model/kinematics.h"
#include "core/trajectory/joint_line.h"
#include "server/physics/contact_oracle.h"
#include "test/physics/physics_cells.h"

namespace armloom::test {
namespace {

using namespace std::chrono_literals;
constexpr Duration kPeriod = 1ms;

Plant plant_of(const CellPtr& cell, const PlantOptions& options) {
  Problems warnings;
  auto plant = Plant::create(cell, options, warnings);
  if (!plant) throw std::runtime_error(plant.error().front().detail);
  return std::move(*plant);
}
Plant left_panda(std::optional<Payload> payload = {}, bool is_payload_known = false) {
  return plant_of(config_cell("two_pandas"), {RobotId{0}, payload, is_payload_known});
}
Payload in_hand(double mass_kg) { return {"left_panda_hand", mass_kg, {0, 0, 0.06}}; }

// Commands a minimum-jerk line at the cell's limits from the state to a goal. Returns the largest
// tracking error of each joint.
Eigen::VectorXd follow_line(Plant& plant, const Cell& cell, const Eigen::VectorXd& from,
                            const Eigen::VectorXd& to, Eigen::VectorXd& worst) {
  const auto line = joint_line(cell, plant.joints(), from, to);
  if (!line) throw std::runtime_error(line.error().front().detail);
  JointState command;
  for (Duration t = kPeriod; t <= (*line)->duration() + 300ms; t += kPeriod) {
    (*line)->sample(t, command);
    const PlantState& state = plant.step(kPeriod, command.position, command.velocity);
    worst = worst.cwiseMax((state.position - command.position).cwiseAbs());
    for (const BodyContact& contact : state.contacts) {
      ADD_FAILURE() << contact.body_a << " touches " << contact.body_b;
    }
  }
  return worst;
}

// Moves a Panda through four far poses at full speed.
Eigen::VectorXd fast_tour(Plant& plant) {
  const CellPtr cell = config_cell("two_pandas");
  const std::vector<std::vector<double>> tour = {{1.2, -0.3, 0.6, -1.6, 0.8, 2.2, -0.6, 0.04},
                                                 {-0.9, 0.2, -0.4, -2.0, -0.9, 1.9, 2.0, 0.0},
                                                 {0.4, -0.8, 1.0, -2.4, 0.4, 2.6, 0.0, 0.02},
                                                 {0, -1.2, 0, -2.6, 0, 1.6, 0.785, 0.0}};
  Eigen::VectorXd at = plant.state().position;
  Eigen::VectorXd worst = Eigen::VectorXd::Zero(at.size());
  for (const auto& goal : tour) {
    const Eigen::VectorXd to = Eigen::Map<const Eigen::VectorXd>(goal.data(), at.size());
    follow_line(plant, *cell, at, to, worst);
    at = to;
  }
  return worst;
}

void print(const char* what, const Eigen::VectorXd& worst) {
  std::printf("%s, largest error per joint (mrad, finger mm):", what);
  for (const double error : worst) std::printf(" %.4f", 1e3 * error);
  std::printf("\n");
}

TEST(Plant, FollowsAFastTour) {
  Plant plant = left_panda();
  const Eigen::VectorXd worst = fast_tour(plant);
  print("no payload", worst);
  EXPECT_LT(worst.maxCoeff(), 2e-4);
}

// Only discretization errors remain: the feedforward is complete.
TEST(Plant, FollowsNearlyExactlyWithExactMasses) {
  Plant plant = plant_of(config_cell("two_pandas"), {.robot = RobotId{0}, .mass_error = 0.0});
  const Eigen::VectorXd worst = fast_tour(plant);
  print("exact masses", worst);
  EXPECT_LT(worst.maxCoeff(), 3e-5);
}

TEST(Plant, PayloadUnknownToTheServoRaisesTheError) {
  Plant unknown = left_panda(in_hand(3.0));
  const Eigen::VectorXd worst = fast_tour(unknown);
  print("3 kg, unknown", worst);
  EXPECT_LT(worst.maxCoeff(), 5e-3);
  EXPECT_GT(worst.maxCoeff(), 1e-3);
  Plant known = left_panda(in_hand(3.0), true);
  const Eigen::VectorXd worst_known = fast_tour(known);
  print("3 kg, known", worst_known);
  EXPECT_LT(worst_known.maxCoeff(), 2e-4);
}

TEST(Plant, EveryConfiguredRobotHoldsItsHome) {
  for (const std::string& name : config_cell_names()) {
    Plant plant = plant_of(config_cell(name), {});
    const Eigen::VectorXd home = plant.state().position;
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
      const PlantState& state = plant.step(kPeriod, home, Eigen::VectorXd::Zero(home.size()));
      worst = std::max(worst, (state.position - home).cwiseAbs().maxCoeff());
      EXPECT_TRUE(state.contacts.empty()) << name;
    }
    std::printf("%s: largest error at home %.3g rad\n", name.c_str(), worst);
    EXPECT_LT(worst, 1e-3) << name;
  }
}

TEST(Plant, HoldsStillForTenSeconds) {
  Plant plant = left_panda();
  const Eigen::VectorXd home = plant.state().position;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(home.size());
  double worst = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const PlantState& state = plant.step(kPeriod, home, rest);
    if (i >= 2000) worst = std::max(worst, (state.position - home).cwiseAbs().maxCoeff());
  }
  std::printf("rest: largest error after 2 s %.3g rad\n", worst);
  EXPECT_LT(worst, 1e-6);
}

TEST(Plant, RepeatsBitForBit) {
  Plant a = left_panda(in_hand(1.0));
  Plant b = left_panda(in_hand(1.0));
  EXPECT_EQ(fast_tour(a), fast_tour(b));
  EXPECT_EQ(a.state().position, b.state().position);
  EXPECT_EQ(a.state().torque, b.state().torque);
  // The next run of the same plant too.
  const Eigen::VectorXd end = a.state().velocity;
  b.place(left_panda().state().position);
  (void)fast_tour(b);
  EXPECT_EQ(b.state().velocity, end);
}

// Gravity torque from our own kinematics: dU/dq, by central differences.
TEST(Plant, TorqueAtRestCarriesTheWeight) {
  const CellPtr cell = config_cell("two_pandas");
  Plant plant = left_panda();
  const Eigen::VectorXd home = plant.state().position;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(home.size());
  for (int i = 0; i < 2000; ++i) (void)plant.step(kPeriod, home, rest);

  std::vector<LinkInertia> inertias;
  for (const Link& link : cell->links) {
    inertias.push_back(inertia_of_shapes(link.shapes, kAssumedDensity_kg_m3));
  }
  const auto potential_j = [&](const Configuration& q) {
    LinkPoses X_WL;
    forward_kinematics(*cell, q, X_WL);
    double sum = 0.0;
    for (std::size_t l = 0; l < X_WL.size(); ++l) {
      if (cell->links[l].robot != RobotId{0}) continue;
      sum += 9.81 * inertias[l].mass_kg * (X_WL[l] * inertias[l].p_LC).z();
    }
    return sum;
  };
  for (std::size_t r = 0; r < 7; ++r) {
    Configuration above = cell->home();
    Configuration below = cell->home();
    const auto joint = static_cast<Eigen::Index>(plant.joints()[r].index());
    above[joint] += 1e-4;
    below[joint] -= 1e-4;
    const double expected = (potential_j(above) - potential_j(below)) / 2e-4;
    EXPECT_NEAR(plant.state().torque[static_cast<Eigen::Index>(r)], expected, 1e-3) << r;
  }
}

// The work of the drives is the change of energy, and nothing else does work.
TEST(Plant, WorkOfDrivesEqualsChangeOfEnergy) {
  Plant plant = left_panda();
  const CellPtr cell = config_cell("two_pandas");
  const Eigen::VectorXd from = plant.state().position;
  Eigen::VectorXd to = from;
  to.head(7) << 0.9, -0.3, 0.4, -1.6, 0.5, 2.0, 0.0;
  const auto line = joint_line(*cell, plant.joints(), from, to);
  ASSERT_TRUE(line.has_value());
  const double before_j = plant.energy_j();
  double work_j = 0.0;
  double lift_j = 0.0;
  JointState command;
  constexpr Duration kShort = 500us;  // one internal step
  for (Duration t = kShort; t <= (*line)->duration() * 3 / 5; t += kShort) {
    (*line)->sample(t, command);
    const Eigen::VectorXd position = plant.state().position;
    const PlantState& state = plant.step(kShort, command.position, command.velocity);
    // The drive of the mimic finger is not in joints(). It hardly works, because it rests.
    work_j += state.torque.dot(state.position - position);
    lift_j = std::max(lift_j, std::abs(plant.energy_j() - before_j));
  }
  std::printf("work %.4f J, change of energy %.4f J\n", work_j, plant.energy_j() - before_j);
  EXPECT_GT(lift_j, 5.0);
  EXPECT_NEAR(work_j, plant.energy_j() - before_j, 0.01 * lift_j);
}

TEST(Plant, ReportsContactOfTwoPandasDrivenIntoEachOther) {
  const CellPtr cell = config_cell("two_pandas");
  Plant plant = plant_of(cell, {});
  Eigen::VectorXd from = plant.state().position;
  Eigen::VectorXd to = from;
  for (std::size_t r = 0; r < plant.joints().size(); ++r) {
    const std::string& name = cell->joint(plant.joints()[r]).name;
    if (name.ends_with("joint2")) to[static_cast<Eigen::Index>(r)] = 0.6;
    if (name.ends_with("joint4")) to[static_cast<Eigen::Index>(r)] = -1.6;
  }
  const auto line = joint_line(*cell, plant.joints(), from, to);
  ASSERT_TRUE(line.has_value());
  JointState command;
  std::vector<BodyContact> first;
  Configuration q = cell->home();
  double deepest_m = 0.0;
  double torque_max = 0.0;
  for (Duration t = kPeriod; t <= (*line)->duration() + 1s; t += kPeriod) {
    (*line)->sample(t, command);
    const PlantState& state = plant.step(kPeriod, command.position, command.velocity);
    torque_max = std::max(torque_max, state.torque.cwiseAbs().maxCoeff());
    for (const BodyContact& contact : state.contacts) {
      deepest_m = std::max(deepest_m, contact.depth_m);
    }
    if (!first.empty() || state.contacts.empty()) continue;
    first = state.contacts;
    q = state.position;
  }
  ASSERT_FALSE(first.empty());
  EXPECT_THAT(first.front().body_a, testing::StartsWith("left_"));
  EXPECT_THAT(first.front().body_b, testing::StartsWith("right_"));
  // The bodies push each other back, at most with the drives' torque.
  std::printf("%s touches %s, deepest %.4f m\n", first.front().body_a.c_str(),
              first.front().body_b.c_str(), deepest_m);
  EXPECT_EQ(torque_max, 87.0);  // the largest effort in the URDF
  EXPECT_LT(deepest_m, 0.02);
  EXPECT_GT((plant.state().position - command.position).norm(), 0.05);
}

TEST(Plant, BrakesStopAndHoldAnArmWithoutDrives) {
  const CellPtr cell = config_cell("two_pandas");
  Plant plant = left_panda();
  const Eigen::VectorXd from = plant.state().position;
  Eigen::VectorXd to = from;
  to.head(7) << 1.2, -0.3, 0.6, -1.6, 0.8, 2.2, -0.6;
  const auto line = joint_line(*cell, plant.joints(), from, to);
  ASSERT_TRUE(line.has_value());
  JointState command;
  Duration t{};
  for (t = kPeriod; t <= (*line)->duration() / 2; t += kPeriod) {
    (*line)->sample(t, command);
    (void)plant.step(kPeriod, command.position, command.velocity);
  }
  const double speed = plant.state().velocity.cwiseAbs().maxCoeff();
  ASSERT_GT(speed, 0.5);
  plant.switch_drives(ArmId{0}, false);
  int until_rest = 0;
  double energy_j = plant.energy_j();
  while (plant.state().velocity.cwiseAbs().maxCoeff() > 1e-3 && until_rest < 1000) {
    (void)plant.step(kPeriod, command.position, command.velocity);
    ++until_rest;
    EXPECT_LT(plant.energy_j(), energy_j + 1e-3);
    energy_j = plant.energy_j();
  }
  EXPECT_LT(until_rest, 200);
  const Eigen::VectorXd rest = plant.state().position;
  for (int i = 0; i < 5000; ++i) (void)plant.step(kPeriod, to, Eigen::VectorXd::Zero(to.size()));
  std::printf("at rest from %.2f rad/s after %d ms; slow motion in 5 s: %.3g rad\n", speed,
              until_rest, (plant.state().position - rest).cwiseAbs().maxCoeff());
  EXPECT_LT((plant.state().position - rest).cwiseAbs().maxCoeff(), 2e-5);

  const Eigen::VectorXd held = plant.state().position;
  plant.switch_drives(ArmId{0}, true);
  for (int i = 0; i < 500; ++i) (void)plant.step(kPeriod, held, Eigen::VectorXd::Zero(to.size()));
  EXPECT_LT((plant.state().position - held).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Plant, WarnsOfAssumedMassesAndRefusesBadPayloads) {
  const CellPtr cell = config_cell("two_pandas");
  Problems warnings;
  ASSERT_TRUE(Plant::create(cell, {RobotId{0}, {}, false}, warnings).has_value());
  ASSERT_EQ(warnings.size(), 1u);
  std::printf("%s\n", warnings[0].detail.c_str());
  EXPECT_EQ(warnings[0].pointer, "robot left");
  EXPECT_THAT(warnings[0].detail, testing::StartsWith("11 links have no <inertial>"));
  const auto other = Plant::create(cell, {RobotId{1}, in_hand(1.0), false}, warnings);
  ASSERT_FALSE(other.has_value());
  EXPECT_EQ(other.error().front().detail, "no link 'left_panda_hand' in the robot");
  const auto negative = Plant::create(cell, {RobotId{0}, in_hand(-1.0), false}, warnings);
  ASSERT_FALSE(negative.has_value());
  EXPECT_THAT(negative.error().front().detail, testing::HasSubstr("-1 kg"));
}

TEST(Plant, RefusesAPayloadThatTheDrivesCannotHold) {
  const CellPtr cell = config_cell("two_pandas");
  Problems warnings;
  const auto create = [&](double mass_kg) {
    return Plant::create(cell, {RobotId{0}, in_hand(mass_kg), false}, warnings);
  };
  const auto refused = create(1e9);
  ASSERT_FALSE(refused.has_value());
  const std::string detail = refused.error().front().detail;
  std::printf("%s\n", detail.c_str());
  const std::string words = "the drives can hold at most ";
  ASSERT_THAT(detail, testing::HasSubstr(words));
  const double most_kg = std::stod(detail.substr(detail.find(words) + words.size()));
  EXPECT_FALSE(create(most_kg + 0.1).has_value());
  auto held = create(most_kg - 0.5);
  ASSERT_TRUE(held.has_value()) << held.error().front().detail;
  const Eigen::VectorXd home = held->state().position;
  for (int i = 0; i < 5000; ++i) {
    (void)held->step(kPeriod, home, Eigen::VectorXd::Zero(home.size()));
  }
  EXPECT_LT((held->state().position - home).cwiseAbs().maxCoeff(), 1e-3) << "holds it";
  EXPECT_GT(most_kg, 3.0) << "the payload of a Panda";
}

// Fails only if the plant is slower than real time; prints the figures.
TEST(Plant, IsFasterThanRealTime) {
  const CellPtr cell = config_cell("two_pandas");
  for (const bool both : {false, true}) {
    Plant plant = both ? plant_of(cell, {}) : left_panda();
    const Eigen::VectorXd home = plant.state().position;
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(home.size());
    const std::clock_t begin = std::clock();
    for (int i = 0; i < 2000; ++i) (void)plant.step(kPeriod, home, rest);
    const double wall_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    std::printf("%s: %.1f times real time\n", both ? "two Pandas" : "one Panda", 2.0 / wall_s);
    EXPECT_LT(wall_s, 2.0);
  }
}

}  // namespace
}  // namespace armloom::test
