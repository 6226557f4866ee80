#pragma once

#include <vector>

#include "core/executive/executive.h"
#include "core/executive/motions.h"

namespace armloom {

// Collects the figures of a session (RunFigures).
class RunCount {
 public:
  explicit RunCount(std::size_t arms);

  void end_of_a_job(TimePoint at);
  // Called in each control cycle.
  void motion(const Motions& motions);
  // Called when the monitor has checked a changed state.
  void look(const std::vector<Proximity>& near);
  void monitor_stop() { ++figures_.monitor_stops; }
  void guard_refusal() { ++figures_.guard_refusals; }

  [[nodiscard]] const RunFigures& figures() const { return figures_; }

 private:
  RunFigures figures_;
};

}  // namespace armloom
