#pragma once

#include <functional>
#include <memory>

#include "core/arm/arm_controller.h"
#include "core/executive/executive.h"

namespace armloom {

// Runs an Executive in (scaled) real time on a thread of its own, with worker threads for
// what it has to know: judgements, diagrams, plans. All public calls are thread-safe.
class RealTimeLoop {
 public:
  // The observer is called on the loop's thread and outlives the loop. speed > 0: cell seconds per
  // wall second.
  [[nodiscard]] static Result<std::unique_ptr<RealTimeLoop>> start(CellPtr cell,
                                                                   ExecutiveOptions options,
                                                                   double speed,
                                                                   Observer& observer);
  ~RealTimeLoop();  // stops the threads; arms stay where they are

  // Runs `command` on the strand, soon: between two control cycles, as many as there is time for.
  // Commands run in the order posted.
  void post(std::function<void(Executive&)> command);
  // A command that takes long, part by part: it is called again until it returns true; those behind
  // it wait, control cycles do not.
  using Task = std::function<bool(Executive&)>;
  void post_in_parts(Task task);
  // Before all that waits, in the order posted: stops and what lets arms go on; what jobs wait for.
  void post_urgent(std::function<void(Executive&)> command);
  // What clients see, without a word to the strand.
  [[nodiscard]] const StatusBoard& board() const;
  [[nodiscard]] double speed() const;
  void set_speed(double speed);  // > 0; from the next control cycle on

 private:
  class Impl;
  explicit RealTimeLoop(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
