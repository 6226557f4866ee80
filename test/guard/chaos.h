#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/collision/check/motion_checker.h"
#include "core/guard/authority_guard.h"
#include "test/collision/small_cell.h"

namespace armloom {

// A cell of spheres on rails that cross near the origin. Its certificates come from the real
// checker, and its distances are known in closed form.
struct RailCell {
  explicit RailCell(std::size_t arms);

  inline static constexpr double kRadius_m = 0.05;
  inline static constexpr double kClearance_m = 0.02;
  inline static constexpr double kEnd_m = 1.0;
  [[nodiscard]] Eigen::Vector3d center(ArmId arm, double q) const;

  CellPtr cell;
  PlanningScenePtr scene;
  std::vector<Eigen::Vector3d> begins, along;  // by ArmId
};

// A scheduler without rules, and arms that obey it. It starts, extends, stops, resumes, cancels and
// forgets motions at random, asks the checker about a part of the cell, and uses old answers. If
// `guarded`, all grants go through the guard; otherwise none do.
class Chaos {
 public:
  Chaos(const RailCell& rails, MotionChecker& checker, std::uint64_t seed, bool guarded);

  struct Outcome {
    double closest_m = 1e9;  // between the surfaces of two arms, or of an arm and the object
    std::size_t grants = 0, refusals = 0, advances = 0;
    std::vector<Configuration> states = {};  // the configurations that were measured
  };
  Outcome run(int steps);

 private:
  struct RailArm {
    double q;                   // position on the rail
    TrajectoryPtr motion = {};  // nullptr if the arm is at rest without a motion
    Duration progress{}, authority{};
    bool stopped = true;
  };
  [[nodiscard]] std::size_t pick(std::size_t below);
  [[nodiscard]] double share();
  [[nodiscard]] bool chance(double probability) { return share() < probability; }
  [[nodiscard]] ArmId any_arm() { return ArmId{static_cast<std::uint32_t>(pick(arms_.size()))}; }
  RailArm& at(ArmId arm) { return arms_[arm.index()]; }
  [[nodiscard]] Configuration where() const;

  void step();
  void begin();
  void ask(const TrajectoryPtr& motion, Duration from);
  void grant(const TrajectoryPtr& motion, Duration from, Duration authority);
  void extend();
  void resume();
  void stop();
  void forget();
  void advance();
  void advance(const TrajectoryPtr& motion);
  void change_scene();
  void come_to_rest(ArmId arm);
  void look();

  const RailCell& rails_;
  MotionChecker& checker_;
  std::mt19937_64 random_;
  bool guarded_;
  PlanningScenePtr scene_;
  std::optional<Eigen::Vector3d> object_;
  std::vector<RailArm> arms_;
  std::vector<Certificate> old_;
  AuthorityGuard guard_;
  Outcome outcome_;
};

}  // namespace armloom
