#pragma once

#include <memory>
#include <span>

#include "core/collision/filter/kernels.h"
#include "core/collision/pair_limits.h"
#include "core/collision/planning_scene.h"
#include "core/model/cell.h"

namespace armloom {

// Decides combined states of the whole cell, up to eight at once: does every pair of parts keep its
// limit? Capsules answer for nearly all pairs; for those that they leave open, and only for these,
// the exact distance does, of meshes where balls inside of them do not prove it first. Holds the
// scratch: one per worker thread, not thread-safe.
class StateCheck {
 public:
  using Limits = PairLimits;
  // Without limits: the cell's.
  explicit StateCheck(PlanningScenePtr scene, const filter::Kernel& kernel = filter::best_kernel());
  StateCheck(PlanningScenePtr scene, Limits limits,
             const filter::Kernel& kernel = filter::best_kernel());
  ~StateCheck();
  StateCheck(StateCheck&&) noexcept;
  StateCheck& operator=(StateCheck&&) noexcept;

  // One bit for each state, the first one lowest: some pair is closer than its limit. Decided
  // exactly (part_distance.h: never a wrong "clear"). Preconditions: 1 to filter::kLanes states,
  // each with one entry per joint of the cell.
  [[nodiscard]] unsigned too_close(std::span<const Configuration* const> states);
  // What the capsules alone say of arms against each other and themselves: bits of states that are
  // not proven clear. For measurements.
  [[nodiscard]] unsigned open_by_capsules(std::span<const Configuration* const> states);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace armloom
