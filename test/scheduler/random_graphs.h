#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <vector>

#include "core/precedence/precedence_graph.h"
#include "test/scheduler/crossings.h"

namespace armloom {

// Random motions of three one-joint arms, alone and in teams, in a PrecedenceGraph without a
// scheduler. Motions are admitted, move within their authority, end or are abandoned, and their
// orders are decided again. Checks after every change:
// - Arms at rest, or anywhere between progress and authority, do not meet.
// - The orders form no cycle.
// - A motion that is held before its end names what holds it.
// Deterministic for equal seeds.
class RandomGraph {
 public:
  explicit RandomGraph(std::uint64_t seed) : random_(seed), crossings_(table()) {}

  // Makes one random change.
  void change();

  struct Count {
    std::uint64_t finished = 0;   // motions that ended at their goals
    std::uint64_t abandoned = 0;  // motions that ended on their paths
    std::uint64_t held = 0;       // motions found at rest at their limits
    std::uint64_t reversed = 0;   // decisions that reversed an order
  };
  [[nodiscard]] const Count& count() const { return count_; }

 private:
  static constexpr std::uint32_t kArms = 3;

  std::vector<Crossing> table();
  double place() { return 0.05 * static_cast<double>(random_() % 20); }
  Duration between(Duration from, Duration to);

  void admit();
  [[nodiscard]] std::optional<CoordinatedMotion> draw(const std::vector<CoordinatedMotion>& before);
  [[nodiscard]] double end_of(ArmId arm, const std::vector<CoordinatedMotion>& motions) const;
  [[nodiscard]] Motion in_question(const CoordinatedMotion& motion,
                                   const std::vector<CoordinatedMotion>& all) const;
  void extend_authority();
  void move_arms();
  void finish();
  void abandon();
  void rest_at(const CoordinatedMotion& motion, Duration progress);
  void decide_again();

  void check();
  [[nodiscard]] Stretch reach(ArmId arm) const;

  std::mt19937_64 random_;
  Crossings crossings_;
  PrecedenceGraph graph_{kArms};
  std::map<StepId, TrajectoryPtr> trajectories_;
  Configuration rest_ = Configuration::Zero(kArms);  // where each arm rests, or last rested
  std::uint64_t next_job_ = 1;
  Count count_;
};

}  // namespace armloom
