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

// The planning scene and its version.
struct VersionedScene {
  PlanningScenePtr scene;
  std::uint64_t version = 1;
};

// The present planning scene, whose objects clients can change. Used on the strand.
class LiveScene {
 public:
  // Returns the present measured positions.
  using Measured = std::function<const Configuration&()>;
  struct Told {
    // Called with each request of a client, also an invalid one.
    std::function<void(const ExecutiveInput&)> asked;
    // Called after a change, with the monitor's query in the new scene.
    std::function<void(ClearanceQuery)> changed;
  };
  LiveScene(PlanningScenePtr scene, Measured measured, Told told)
      : now_{std::move(scene)}, measured_(std::move(measured)), told_(std::move(told)) {}

  [[nodiscard]] const VersionedScene& now() const { return now_; }
  [[nodiscard]] const PlanningScenePtr& scene() const { return now_.scene; }
  [[nodiscard]] std::uint64_t version() const { return now_.version; }
  [[nodiscard]] const std::vector<CollisionObject>& objects() const {
    return now_.scene->objects();
  }

  // Change the objects. Every motion under way and every waiting job is then checked again.
  // Problems: a name that is in use (of an object, a link or a robot) or unknown; a shape that is
  // closer to the measured position of an arm than the monitor's stop_clearance.
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
