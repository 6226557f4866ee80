#pragma once

#include <vector>

#include "core/executive/executive.h"
#include "core/executive/motions.h"

namespace armloom {

// Counts the figures of a run.
class RunCount {
 public:
  explicit RunCount(std::size_t arms);

  void end_of_a_job(TimePoint at);
  // Each control cycle.
  void motion(const Motions& motions);
  // Each look of the monitor at another state.
  void look(const std::vector<Proximity>& near);
  void monitor_stop() { ++figures_.monitor_stops; }
  void guard_refusal() { ++figures_.guard_refusals; }

  [[nodiscard]] const RunFigures& figures() const { return figures_; }

 private:
  RunFigures figures_;
};

}  // namespace armloom
