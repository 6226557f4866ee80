#include "core/executive/live_scene.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "core/executive/executive_input.h"
#include "core/executive/state_watch.h"

namespace armloom {
namespace {

auto named(const std::string& name) {
  return [&name](const CollisionObject& object) { return object.name == name; };
}

// Conflicts and allowed pairs name links and objects alike: a name means one body.
std::optional<Problem> taken_in_cell(const std::string& name, const Cell& cell) {
  const auto has_name = [&name](const auto& part) { return part.name == name; };
  const char* whose = std::ranges::any_of(cell.links, has_name)    ? "link"
                      : std::ranges::any_of(cell.robots, has_name) ? "robot"
                                                                   : nullptr;
  if (whose == nullptr) return std::nullopt;
  return Problem{ProblemKind::conflict, "name-taken", "/name",
                 "a " + std::string(whose) + " is named \"" + name + "\" already", name};
}

Problem no_object(const std::string& name) {
  return Problem{ProblemKind::not_found, "unknown-object", "",
                 "no object is named \"" + name + "\"", name};
}

}  // namespace

Result<void> LiveScene::add(CollisionObject object) {
  told_.asked({ExecutiveInput::ObjectAdded{object}});
  if (auto taken = taken_in_cell(object.name, now_.scene->cell()))
    return failure(std::move(*taken));
  std::vector<CollisionObject> all = objects();
  if (std::ranges::any_of(all, named(object.name))) {
    return failure(Problem{ProblemKind::conflict, "name-taken", "/name",
                           "an object is named \"" + object.name + "\" already", object.name});
  }
  all.push_back(std::move(object));
  return change(std::move(all));
}

Result<void> LiveScene::replace(CollisionObject object) {
  told_.asked({ExecutiveInput::ObjectReplaced{object}});
  std::vector<CollisionObject> all = objects();
  const auto old = std::ranges::find_if(all, named(object.name));
  if (old == all.end()) return failure(no_object(object.name));
  *old = std::move(object);
  return change(std::move(all));
}

Result<void> LiveScene::remove(const std::string& name) {
  told_.asked({ExecutiveInput::ObjectRemoved{name}});
  std::vector<CollisionObject> all = objects();
  if (std::erase_if(all, named(name)) == 0) return failure(no_object(name));
  return change(std::move(all));
}

// An object may not be set where an arm stands: that is a mistake, or an accident that the monitor
// would answer with a stop.
Result<void> LiveScene::change(std::vector<CollisionObject> objects) {
  auto scene = now_.scene->with_objects(std::move(objects));
  if (!scene) return failure(std::move(scene.error()));
  ClearanceQuery query = StateWatch::query_of(*scene);
  for (const NearPair& closer : query.near_pairs(measured_())) {
    const Proximity pair = query.describe(closer);
    if (!pair.object_b) continue;
    char figures[96];
    std::snprintf(figures, sizeof figures, pair.clearance_m < 0.0 ? "overlap " : "be %.4f m from ",
                  pair.clearance_m);
    std::string text = pair.body_b + " would " + figures + pair.body_a + " at its present position";
    if (pair.clearance_m < 0.0) text += " by " + in_mm(pair.clearance_m);
    std::snprintf(figures, sizeof figures, ", limit %.4f m", pair.limit_m);
    return failure(
        Problem{ProblemKind::conflict, "object-in-arm", "", text + figures, pair.clearance_m});
  }
  now_ = {std::move(*scene), now_.version + 1};
  told_.changed(std::move(query));
  return {};
}

}  // namespace armloom
