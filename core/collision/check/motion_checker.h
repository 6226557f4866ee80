#pragma once

#include "core/collision/diagram/motion_store.h"
#include "core/collision/state/clearance_query.h"
#include "core/coordination/diagram.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Answers Questions by the method that they name. Keeps the tubes of motions and the diagrams of
// pairs as long as questions use them, so that repeating a question later costs next to nothing.
//
// Swept: checks candidates against themselves, static bodies, each other, and every other motion or
// resting arm: all that remains of one motion against all that remains of the other. Arms of one
// synchronous motion are checked as in Coordinated. Every such state keeps the cell's clearance_m
// (self_clearance_m of an arm from itself, mount_clearance_m from its mount), tracking error and
// motion bounds (motion_tube.h) included.
// - Conflicts name one state for each counterpart; for an arm alone the first in time, to within
//   CoordinationDiagram::kFirst_s.
// - `undecided`: neither is proven. The conflicts are then the cells that could not be decided.
// - `clearance_bound` of a free verdict: the smallest limits that pairs were held to.
//
// Coordinated: checks candidates against themselves and static bodies, from their progress on, as
// above. Arms of one synchronous motion are checked against each other in step, and as far ahead of
// each other as they can get (in_step.h). If all this is free, the verdict is free, and names the
// conflict regions of the pairs (pair_regions.h) with the same margins.
//
// Pairs that are too close at the start of the question may part if the question permits it
// (may_part). They are in conflict only if they come closer than OrientedDiagram::kPartingShare of
// their present distance.
//
// Has scratch memory, so not thread-safe: use one per worker thread. Deterministic: equal questions
// in equal order get equal answers, evaluations included.
class MotionChecker {
 public:
  explicit MotionChecker(PlanningScenePtr scene)
      : store_(std::move(scene)), query_(store_.scene()) {}

  // Uses this scene of the same cell from now on. Diagrams of pairs of arms are kept if the
  // attached objects are the same.
  void look_at(PlanningScenePtr scene);
  [[nodiscard]] const PlanningScenePtr& scene() const { return store_.scene(); }

  // Preconditions as for timed_discrete_check(). Another thread may watch `progress` and end the
  // check early. The verdict is then void (Verdict::interrupted), and all diagrams are dropped, so
  // that later answers do not depend on how far the check came.
  [[nodiscard]] Verdict judge(const Question& question, CheckProgress* progress = nullptr);
  // Returns the verdict of an interrupted check, and drops all diagrams like it.
  [[nodiscard]] Verdict interrupted(const Question& question);

  // Returns the whole coordination diagram of two motions of different arms. Neighboring cells of
  // equal state are merged.
  [[nodiscard]] Diagram draw(const Drawing& drawing, CheckProgress* progress = nullptr);

  // Cell budget of a pair of motions for each 10 s of the longer one. A question that needs more is
  // undecided.
  inline static constexpr std::uint64_t kBudget = 1000;

 private:
  MotionStore store_;
  ClearanceQuery query_;
};

}  // namespace armloom
