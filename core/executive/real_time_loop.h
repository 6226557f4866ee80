#pragma once

#include <functional>
#include <memory>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

// Runs an Executive in (scaled) real time on its own thread, with worker threads for checks,
// diagrams and plans. All public functions are thread-safe.
class RealTimeLoop {
 public:
  // `observer` is called on the loop's thread and outlives the loop. `speed` > 0: cell seconds per
  // wall second.
  [[nodiscard]] static Result<std::unique_ptr<RealTimeLoop>> start(CellPtr cell,
                                                                   ExecutiveOptions options,
                                                                   double speed,
                                                                   Observer& observer);
  ~RealTimeLoop();  // stops the threads; the arms stay where they are

  // Runs `command` on the strand, between two control cycles, when time permits. Commands run in
  // the order in which they are posted.
  void post(std::function<void(Executive&)> command);
  // Runs a long command in parts: calls `task` again and again until it returns true. Later
  // commands wait for its end, but control cycles run in between.
  using Task = std::function<bool(Executive&)>;
  void post_in_parts(Task task);
  // Runs `command` before all commands that are not urgent, in the order posted. For stops,
  // resumes, and answers that jobs wait for.
  void post_urgent(std::function<void(Executive&)> command);
  [[nodiscard]] const StatusBoard& board() const;
  [[nodiscard]] double speed() const;
  void set_speed(double speed);  // > 0; from the next control cycle on

 private:
  class Impl;
  explicit RealTimeLoop(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
