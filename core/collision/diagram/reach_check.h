#pragma once

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/collision/diagram/motion_tube.h"
#include "core/collision/diagram/tube_pair.h"
#include "core/collision/scene/planning_scene.h"
#include "core/coordination/proximity.h"
#include "core/coordination/reach.h"

namespace armloom {

// Decides if arms may come too close within what they can reach next. Covers every combination of
// configurations of both reaches that the arms may take at the same time (Reach::rate_low and
// rate_high). Errs only on the side of "too close": if the budget ends, the answer is "may meet".
// Pairs of bodies that are too close already need only keep 80 % of their present distance, so that
// arms can move apart. Not thread-safe.
class ReachCheck {
 public:
  // `clearance_m`: required distance (PairLimits::scaled).
  ReachCheck(PlanningScenePtr scene, double clearance_m);

  // Returns evidence if the two arms may come too close, else nullopt. The evidence is the closest
  // pair found; its distance is exact if it is below the limit. Precondition: a.arm != b.arm.
  [[nodiscard]] std::optional<Proximity> may_meet(const Reach& a, const Reach& b);
  // Likewise for an arm and static bodies.
  [[nodiscard]] std::optional<Proximity> may_meet_scene(const Reach& reach);
  // Number of cells evaluated so far.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

  // Reaches are divided down to this width (trajectory time).
  inline static constexpr Duration kResolution = std::chrono::milliseconds(1);
  inline static constexpr std::uint64_t kBudget = 400;  // cells of one question

 private:
  [[nodiscard]] std::optional<Proximity> closest(const PairSet& pairs, const Reach& of_a,
                                                 const Reach* of_b, std::shared_ptr<MotionTube> b);
  [[nodiscard]] std::shared_ptr<MotionTube> tube(const Reach& reach);

  PlanningScenePtr scene_;
  PairLimits limits_;
  // By ArmId, then the static bodies, which are made on first use.
  std::vector<std::shared_ptr<const ArmGeometry>> geometry_;
  std::vector<std::shared_ptr<MotionTube::Scratch>> tube_scratch_;
  std::shared_ptr<MotionTube> still_;
  std::shared_ptr<TubePair::Scratch> scratch_;
  std::map<std::pair<ArmId, std::optional<ArmId>>, PairSet> pairs_;  // made on first use
  std::uint64_t evaluations_ = 0;
};

}  // namespace armloom
