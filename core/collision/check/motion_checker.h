#pragma once

#include "core/collision/diagram/motion_store.h"
#include "core/collision/state/clearance_query.h"
#include "core/coordination/diagram.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers Questions by the method that they name. Keeps tubes and diagrams as long as questions use
// them, so that repeating a question costs next to nothing.
//
// Swept: checks what remains of the candidates against themselves, static bodies, each other, and
// what remains of every other motion or resting arm. Arms of one synchronous motion are checked as
// in Coordinated. The cell's clearance_m (self_clearance_m of an arm from itself, mount_clearance_m
// from its mount) is kept in every such state, with the tracking error.
// - Conflicts name one state for each counterpart; for an arm alone the first in time, to within
//   CoordinationDiagram::kFirst_s.
// - `undecided`: neither is proven; the conflicts are cells that could not be decided.
// - `clearance_bound` of a free verdict: the smallest limits of all pairs.
//
// Coordinated: checks candidates against themselves and static bodies as above, and arms of one
// synchronous motion as far ahead of each other as they can get (in_step.h). If all this is free,
// the verdict is free and names the conflict regions of the pairs (pair_regions.h), with the same
// margins.
//
// If the question permits (may_part), pairs that are too close at its start may part: they must
// keep OrientedDiagram::kPartingShare of their present distance.
//
// Deterministic: equal questions in equal order get equal answers, evaluations included. Not
// thread-safe: use one per worker thread.
class MotionChecker {
 public:
  explicit MotionChecker(PlanningScenePtr scene)
      : store_(std::move(scene)), query_(store_.scene()) {}

  // Switches to another scene of the cell. Keeps diagrams of pairs of arms if the attached objects
  // are the same.
  void look_at(PlanningScenePtr scene);
  [[nodiscard]] const PlanningScenePtr& scene() const { return store_.scene(); }

  // Preconditions as for timed_discrete_check(). Another thread may end the check early by
  // `progress`. The verdict is then void (Verdict::interrupted) and all diagrams are dropped, so
  // that later answers do not depend on when the check ended.
  [[nodiscard]] Verdict judge(const Question& question, CheckProgress* progress = nullptr);
  // Returns the verdict of an interrupted check; drops all diagrams.
  [[nodiscard]] Verdict interrupted(const Question& question);

  // Returns the coordination diagram of two motions of different arms, with neighbors of equal
  // state merged.
  [[nodiscard]] Diagram draw(const Drawing& drawing, CheckProgress* progress = nullptr);

  // Cell budget of a pair of motions for each 10 s of the longer motion.
  inline static constexpr std::uint64_t kBudget = 1000;

 private:
  MotionStore store_;
  ClearanceQuery query_;
};

}  // namespace armloom
