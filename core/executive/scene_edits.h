#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "core/executive/live_scene.h"
#include "core/executive/worker.h"

namespace armloom {

// The queue of edits of the scene: a worker thread prepares the edits one after the other, and the
// strand swaps the scene. Used on the strand.
class SceneEdits {
 public:
  using Apply = std::function<void(LiveScene&)>;
  // `post` runs a task on the strand, when time permits. Called on the worker thread.
  explicit SceneEdits(std::function<void(Apply)> post) : post_(std::move(post)) {}
  void end() { maker_.end(); }  // ends the thread; on any thread

  // See RealTimeLoop::edit_scene().
  using ObjectsTo = std::function<std::optional<Problem>(std::uint64_t version)>;
  using Then = std::function<void(const Result<SceneEdited>&)>;
  struct Waiting {
    SceneEdit edit;
    ObjectsTo objects_to;
    Then then;
  };
  void add(Waiting edit, LiveScene& scene);
  // Adds the edit that removes what has expired, unless it is in the queue.
  void add_expiry(LiveScene& scene, TimePoint now);

 private:
  void prepare_next(LiveScene& scene);
  void apply_first(LiveScene& scene, PreparedEdit& prepared);

  std::function<void(Apply)> post_;
  std::deque<Waiting> waiting_;  // the first is being prepared
  bool has_expiry_ = false;
  Worker maker_;
};

}  // namespace armloom
