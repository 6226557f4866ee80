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
// Swept: checks what remains of each candidate against
// - itself and static bodies,
// - what remains of the other candidates and of every other motion,
// - every arm at rest.
// Arms of one synchronous motion are checked as in Coordinated. In a free verdict, every such state
// keeps the cell's clearance_m, including the tracking error. An arm keeps self_clearance_m from
// itself and mount_clearance_m from its mount.
// - Each conflict is one state for one counterpart. If the arm alone is in conflict, it is the
//   first conflict in time, to within CoordinationDiagram::kFirst_s.
// - `undecided`: neither a conflict nor freedom is proven. The conflicts are cells that could not
//   be decided.
// - `clearance_bound` of a free verdict: the smallest limits of all pairs.
//
// Coordinated: checks candidates against themselves and static bodies as above. Arms of one
// synchronous motion are checked as far ahead of each other as they can get (in_step.h). If all of
// these are free, the verdict is free. It then names the conflict regions of the pairs
// (pair_regions.h), with the same margins.
//
// If the question permits it (may_part), pairs that are too close at the start may move apart. They
// must keep their present distance, at most their limit (TubePair::near_at).
//
// Deterministic: equal questions in equal order get equal answers, evaluations included. Not
// thread-safe: use one MotionChecker per worker thread.
class MotionChecker {
 public:
  explicit MotionChecker(PlanningScenePtr scene) : store_(std::move(scene)) {}

  // Switches to another scene. If the cell and the attached objects are the same, keeps the
  // diagrams that the change does not meet (MotionStore).
  void look_at(PlanningScenePtr scene);
  [[nodiscard]] const PlanningScenePtr& scene() const { return store_.scene(); }

  // Preconditions are those of timed_discrete_check(). Another thread may end the check early
  // through `progress`. The verdict is then void (Verdict::interrupted), and all diagrams are
  // dropped. So later answers do not depend on the moment at which the check ended.
  [[nodiscard]] Verdict judge(const Question& question, CheckProgress* progress = nullptr);
  // Returns the verdict of an interrupted check; drops all diagrams.
  [[nodiscard]] Verdict interrupted(const Question& question);

  // Returns the coordination diagram of two motions of different arms. Neighboring cells of equal
  // state are merged.
  [[nodiscard]] Diagram draw(const Drawing& drawing, CheckProgress* progress = nullptr);

  // Cell budget of a pair of motions for each 10 s of the longer motion.
  inline static constexpr std::uint64_t kBudget = 1000;

 private:
  MotionStore store_;
  std::optional<ClearanceQuery> query_;  // in the present scene; made on first use
};

}  // namespace armloom
