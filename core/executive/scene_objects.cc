#include "core/executive/scene_objects.h"

#include <algorithm>
#include <optional>
#include <utility>

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

Result<SceneObjects> with_object(const PlanningScene& scene, CollisionObject added) {
  if (auto taken = taken_in_cell(added.name, scene.cell())) return failure(std::move(*taken));
  SceneObjects objects = scene.objects();
  if (std::ranges::any_of(objects, named(added.name))) {
    return failure(Problem{ProblemKind::conflict, "name-taken", "/name",
                           "an object is named \"" + added.name + "\" already", added.name});
  }
  objects.push_back(std::move(added));
  return objects;
}

Result<SceneObjects> with_other_object(const PlanningScene& scene, CollisionObject replacing) {
  SceneObjects objects = scene.objects();
  const auto old = std::ranges::find_if(objects, named(replacing.name));
  if (old == objects.end()) return failure(no_object(replacing.name));
  *old = std::move(replacing);
  return objects;
}

Result<SceneObjects> without_object(const PlanningScene& scene, const std::string& name) {
  SceneObjects objects = scene.objects();
  if (std::erase_if(objects, named(name)) == 0) return failure(no_object(name));
  return objects;
}

}  // namespace armloom
