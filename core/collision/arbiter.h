#pragma once

#include <memory>
#include <optional>

#include "core/collision/collision_checker.h"
#include "core/collision/coordination_diagram.h"
#include "core/coordination/diagram.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers Questions by the method that they name, and keeps what it has learnt: the tubes of
// motions and the coordination diagrams of pairs live as long as they are asked about, so that a
// question asked again as time goes on costs next to nothing.
//
// Certified and Swept: candidates against themselves, what stands still, each other and every other
// motion or resting arm; each arm's motion bounds (motion_tube.h), the cell's clearance_m
// (self_clearance_m of an arm from itself, mount_clearance_m from its mount) and the tracking error
// are kept in every state that the question's regions hold (region.h): the band of `lag` behind
// each plan, and ahead of it the reaction time and stopping_reach_s() of each motion; a motion that
// may stand, anywhere between where it is and its plan. Swept: the whole rectangle of what remains
// of both. Conflicts name the first state in time with each counterpart, found to within
// CoordinationDiagram::kFirst_s; `undecided`: nothing is proven either way, the conflicts are the
// cells that could not be decided. `clearance_bound_m` of a free verdict: what is proven to be kept
// between different arms and the scene, so the smallest limit that such a pair was held to.
//
// Coordinated: candidates against themselves and what stands still, from their progress on, as
// above; the arms of one synchronous motion against each other, in step and as far ahead of each
// other as they can get (in_step.h). Where that is free the verdict is, and names the regions of
// the pairs (pair_regions.h) with the same margins. find_earliest is not heeded.
//
// find_earliest: motions of candidates that have not begun are shifted to later starts until
// nothing is in their way any more; each conflict that is found says how far at least (see
// next_free_shift). The start is within kShift_s of one that is not free; a gap shorter than
// kWindow_s may be passed over.
//
// Pairs that are too close at the question's beginning may part: they are held to
// kPartingShare of the distance that they have there, and are no conflict while they keep that.
//
// Holds the scratch: one per worker thread, not thread-safe. Deterministic: the same questions in
// the same order have the same answers, evaluations included.
class Arbiter {
 public:
  explicit Arbiter(PlanningScenePtr scene);
  ~Arbiter();
  Arbiter(Arbiter&&) noexcept;
  Arbiter& operator=(Arbiter&&) noexcept;

  // From now on judges in this scene of the same cell. Diagrams of arms are kept.
  void look_at(PlanningScenePtr scene);
  [[nodiscard]] const PlanningScenePtr& scene() const;

  // Preconditions as judge() has them.
  [[nodiscard]] Verdict judge(const Question& question);

  // The whole coordination diagram of two motions of different arms, at `resolution` and at the
  // cost of about `budget` cells for each layer, neighbours of one state joined; other joints stand
  // as in `rest`.
  [[nodiscard]] Diagram draw(const TrajectoryPtr& a, const TrajectoryPtr& b,
                             const Configuration& rest, double tracking_error, Duration resolution,
                             std::uint64_t budget);

  // A pair of motions needs no more cells than this, for each 10 s of the longer one; else its
  // question is undecided.
  inline static constexpr std::uint64_t kBudget = 1000;
  inline static constexpr double kPartingShare = 0.8;
  inline static constexpr double kShift_s = 0.02;
  inline static constexpr double kWindow_s = 0.16;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
