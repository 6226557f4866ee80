#pragma once

#include "core/collision/diagram/motion_store.h"
#include "core/collision/state/clearance_query.h"
#include "core/coordination/diagram.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers Questions by the method that they name, and keeps what it has learnt: the tubes of
// motions and the coordination diagrams of pairs live as long as they are asked about, so that a
// question asked again as time goes on costs next to nothing.
//
// Swept: candidates against themselves, what stands still, each other and every other motion or
// resting arm, all of what remains of one against all of the other; but the arms of one synchronous
// motion as Coordinated has it. With each arm's motion bounds
// (motion_tube.h) and the tracking error the cell's clearance_m (self_clearance_m of an arm from
// itself, mount_clearance_m from its mount) is kept in every such state. Conflicts name one state
// with each counterpart, of an arm alone the first in time, to within
// CoordinationDiagram::kFirst_s; `undecided`: nothing is proven either way, the conflicts are the
// cells that could not be decided. `clearance_bound` of a free verdict: the smallest limits
// that pairs were held to.
//
// Coordinated: candidates against themselves and what stands still, from their progress on, as
// above; the arms of one synchronous motion against each other, in step and as far ahead of each
// other as they can get (in_step.h). Where that is free the verdict is, and names the regions of
// the pairs (pair_regions.h) with the same margins.
//
// Pairs that are too close at the question's beginning may part: they are held to
// OrientedDiagram::kPartingShare of the distance that they have there, and are no conflict while
// they keep that; unless the question does not let them (may_part).
//
// Holds the scratch: one per worker thread, not thread-safe. Deterministic: the same questions in
// the same order have the same answers, evaluations included.
class MotionChecker {
 public:
  explicit MotionChecker(PlanningScenePtr scene)
      : store_(std::move(scene)), query_(store_.scene()) {}

  // From now on judges in this scene of the same cell. Diagrams of arms are kept.
  void look_at(PlanningScenePtr scene);
  [[nodiscard]] const PlanningScenePtr& scene() const { return store_.scene(); }

  // Preconditions as timed_discrete_check() has them.
  // `progress`: another thread may watch it and end the check early. Then the verdict is void
  // (Verdict::interrupted) and everything learnt is forgotten, so that later answers do not depend
  // on how far the check came.
  [[nodiscard]] Verdict judge(const Question& question, CheckProgress* progress = nullptr);
  // The verdict of a check that was interrupted; forgets as that does.
  [[nodiscard]] Verdict interrupted(const Question& question);

  // The whole coordination diagram of two motions of different arms, neighbours of one state
  // joined.
  [[nodiscard]] Diagram draw(const Drawing& drawing, CheckProgress* progress = nullptr);

  // A pair of motions needs no more cells than this, for each 10 s of the longer one; else its
  // question is undecided.
  inline static constexpr std::uint64_t kBudget = 1000;

 private:
  MotionStore store_;
  ClearanceQuery query_;
};

}  // namespace armloom
