#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"
#include "core/collision/state/clearance_query.h"

namespace armloom {

struct ExecutiveInput;

// The planning scene, and which of its versions it is.
struct VersionedScene {
  PlanningScenePtr scene;
  std::uint64_t version = 1;
};

// The planning scene as it is now, and its objects as clients change them. On the strand.
class LiveScene {
 public:
  // Where all joints stand, whenever it is asked.
  using Measured = std::function<const Configuration&()>;
  struct Told {
    std::function<void(const ExecutiveInput&)> asked;  // a client wants a change, good or not
    std::function<void(ClearanceQuery)> changed;       // of the new scene, what the monitor asks
  };
  LiveScene(PlanningScenePtr scene, Measured measured, Told told)
      : now_{std::move(scene)}, measured_(std::move(measured)), told_(std::move(told)) {}

  [[nodiscard]] const VersionedScene& now() const { return now_; }
  [[nodiscard]] const PlanningScenePtr& scene() const { return now_.scene; }
  [[nodiscard]] std::uint64_t version() const { return now_.version; }
  [[nodiscard]] const std::vector<CollisionObject>& objects() const {
    return now_.scene->objects();
  }

  // Every motion under way and every waiting job is judged again. Problems: a name that is in use
  // (of an object, a link or a robot), or unknown; a shape inside an arm as measured (nearer than
  // the monitor's stop_clearance).
  [[nodiscard]] Result<void> add(CollisionObject object);
  [[nodiscard]] Result<void> replace(CollisionObject object);
  [[nodiscard]] Result<void> remove(const std::string& name);

 private:
  [[nodiscard]] Result<void> change(std::vector<CollisionObject> objects);

  VersionedScene now_;
  Measured measured_;
  Told told_;
};

}  // namespace armloom
