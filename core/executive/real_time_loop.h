#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

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
  // Changes the scene. A worker thread prepares the edits one after the other, in the order posted;
  // the strand only swaps the scene (LiveScene). `then` is called on the strand. Problems: those of
  // LiveScene::apply(); that of `objects_to`, which is called with the scene's version just before
  // the swap and may be null; unavailable: too many edits wait.
  using ObjectsTo = std::function<std::optional<Problem>(std::uint64_t version)>;
  void edit_scene(SceneEdit edit, ObjectsTo objects_to,
                  std::function<void(const Result<SceneEdited>&)> then);
  [[nodiscard]] const StatusBoard& board() const;
  [[nodiscard]] double speed() const;
  void set_speed(double speed);  // > 0; from the next control cycle on

 private:
  class Impl;
  explicit RealTimeLoop(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
