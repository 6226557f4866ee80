#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/problem.h"
#include "core/collision/scene/planning_scene.h"
#include "core/collision/state/clearance_query.h"
#include "core/executive/events.h"

namespace armloom {

struct ExecutiveInput;

// The planning scene and its version.
struct VersionedScene {
  PlanningScenePtr scene;
  std::uint64_t version = 1;
};

// Edits of the scene: changes as clients request them.
struct ObjectAdded {
  CollisionObject object;
};
struct ObjectReplaced {
  CollisionObject object;
};
struct ObjectPut {  // becomes ObjectAdded or ObjectReplaced
  CollisionObject object;
};
struct ObjectRemoved {
  std::string name;
};
// Sets all objects at once. An object with the name of an object of the cell file replaces it.
// Objects of the cell file that are not named stay as they are. All other objects are removed.
struct ObjectsSet {
  std::shared_ptr<const std::vector<CollisionObject>> objects;
  std::optional<Duration> expires_in = {};  // from the swap on; see SceneExpiry
};
// Removes objects whose time is over (LiveScene::due). LiveScene::apply() removes what is due then.
struct ObjectsExpired {
  std::vector<std::string> names;
};
using SceneEdit =
    std::variant<ObjectPut, ObjectAdded, ObjectReplaced, ObjectRemoved, ObjectsSet, ObjectsExpired>;

// Objects that are removed at a time, because their client said so (ObjectsSet::expires_in). An
// object leaves the list when it is set again or attached. Objects of the cell file never expire.
struct SceneExpiry {
  TimePoint at = TimePoint::max();
  // Ascending, of objects in the scene; nullptr if there are none.
  std::shared_ptr<const std::vector<std::string>> names = {};
};

// Largest number of objects that clients can bring a scene to, the cell file's included.
inline constexpr std::size_t kObjectsMax = 5000;

// The result of an edit.
struct SceneEdited {
  std::uint64_t version;
  bool created;                      // the object is new
  std::vector<std::string> removed;  // names
  SceneExpiry expiry = {};           // after the edit
};

// An edit with the scene that it makes of another scene. LiveScene::apply() leaves here what it
// replaced, so that the caller frees it where time permits.
struct PreparedEdit {
  PlanningScenePtr base;
  SceneEdit edit;  // not ObjectPut
  struct Made {
    PlanningScenePtr scene;
    std::unique_ptr<ClearanceQuery> query;  // the monitor's
    // Names of the objects that are new or changed, ascending.
    std::vector<std::string> changed;
    std::vector<std::string> removed;
    // Names of the objects that can expire; nullptr unless the edit is ObjectsSet::expires_in.
    std::shared_ptr<const std::vector<std::string>> expiring = {};
  };
  Result<Made> made;
};
// Makes the scene: fits the shapes that `base` does not have, and lists all pairs. Costs
// milliseconds, and about a microsecond for each object of the scene. Pure; on any thread. Problems
// in `made`:
// - a name that is in use (of an object, a link or a robot), unknown, or given twice
// - more than kObjectsMax objects, if the edit adds some
[[nodiscard]] PreparedEdit prepare(SceneEdit edit, const PlanningScenePtr& base);

// The present planning scene, whose objects clients can change. Used on the strand.
//
// An edit takes effect in one step, when apply() swaps the scene. Until then, everything is checked
// and granted against the scene before: while a worker prepares the edit, its client has no answer.
// From then on,
// - no authority is granted under certificates that lack a present object (core/guard),
// - the monitor watches the new scene,
// - motions under way are checked again if a new or changed object is within their arm's reach, and
//   waiting jobs are all checked again.
// So when a client has the answer, nothing more starts or goes on unchecked. A replay repeats the
// edit at the swap; how long its preparation took does not matter.
class LiveScene {
 public:
  // Returns the present measured positions.
  using Measured = std::function<const Configuration&()>;
  struct Told {
    // Called with each request of a client, also an invalid one.
    std::function<void(const ExecutiveInput&)> asked;
    // Called after a change, with the monitor's query in the new scene. Swaps it with the query
    // before.
    std::function<void(ClearanceQuery&)> changed;
    std::function<TimePoint()> now;
  };
  LiveScene(PlanningScenePtr scene, Measured measured, Told told)
      : now_{std::move(scene)}, measured_(std::move(measured)), told_(std::move(told)) {}

  [[nodiscard]] const VersionedScene& now() const { return now_; }
  [[nodiscard]] const PlanningScenePtr& scene() const { return now_.scene; }
  [[nodiscard]] std::uint64_t version() const { return now_.version; }
  // Returns the version that the last change() or expiry made; zero if there was none.
  [[nodiscard]] std::uint64_t version_of_change() const { return version_of_change_; }
  [[nodiscard]] const std::vector<CollisionObject>& objects() const {
    return now_.scene->objects();
  }
  [[nodiscard]] const SceneExpiry& expiry() const { return expiry_; }
  // Returns the edit that removes what has expired by `now`, if there is such a thing. The loop
  // that calls Executive::tick() applies it.
  [[nodiscard]] std::optional<ObjectsExpired> due(TimePoint now) const;
  // Returns the names of the objects that expired with the present version; mostly none.
  [[nodiscard]] const std::vector<std::string>& expired() const;

  // Swaps the scene. Prepares the edit again if the scene has changed since. Problems: those of
  // prepare(); a new or changed object that is closer to the measured position of an arm than the
  // monitor's stop_clearance. The scene then stays as it was.
  [[nodiscard]] Result<SceneEdited> apply(PreparedEdit& prepared);

  // Changes what arms hold, and what may touch. Not an input: it follows from the inputs. Problems:
  // those of PlanningScene::with().
  [[nodiscard]] Result<void> change(PlanningScene::Content content);

  // The link carries the object, with its pose in the link's frame. For a restart. Problems: those
  // of PlanningScene::with().
  [[nodiscard]] Result<void> hold(const HeldView& held);
  // These objects expire, and no others. For a restart. Ignores names that are not in the scene.
  void restore(SceneExpiry expiry);

  // Prepare and apply an edit at once.
  [[nodiscard]] Result<void> add(CollisionObject object);
  [[nodiscard]] Result<void> replace(CollisionObject object);
  [[nodiscard]] Result<void> remove(const std::string& name);
  [[nodiscard]] Result<void> set(std::vector<CollisionObject> objects);
  [[nodiscard]] Result<void> edit(SceneEdit edit);

 private:
  [[nodiscard]] std::optional<Problem> object_in_arm(const PreparedEdit& prepared) const;
  void take_expiry(const PreparedEdit& prepared);
  void never_expires(const std::string& name);

  VersionedScene now_;
  std::uint64_t version_of_change_ = 0;
  SceneExpiry expiry_;
  std::vector<std::string> expired_;  // with the version below
  std::uint64_t version_of_expiry_ = 0;
  Measured measured_;
  Told told_;
};

}  // namespace armloom
