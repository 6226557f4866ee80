// What can change around the jobs: objects of the scene, faults of the simulated arms.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "core/executive/executive_impl.h"

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

Result<void> Executive::Impl::add_object(CollisionObject object) {
  if (auto taken = taken_in_cell(object.name, *cell_)) return failure(std::move(*taken));
  std::vector<CollisionObject> objects = scene_->objects();
  if (std::ranges::any_of(objects, named(object.name))) {
    return failure(Problem{ProblemKind::conflict, "name-taken", "/name",
                           "an object is named \"" + object.name + "\" already", object.name});
  }
  objects.push_back(std::move(object));
  return change_objects(std::move(objects));
}

Result<void> Executive::Impl::replace_object(CollisionObject object) {
  std::vector<CollisionObject> objects = scene_->objects();
  const auto old = std::ranges::find_if(objects, named(object.name));
  if (old == objects.end()) return failure(no_object(object.name));
  *old = std::move(object);
  return change_objects(std::move(objects));
}

Result<void> Executive::Impl::remove_object(const std::string& name) {
  std::vector<CollisionObject> objects = scene_->objects();
  if (std::erase_if(objects, named(name)) == 0) return failure(no_object(name));
  return change_objects(std::move(objects));
}

// An object may not be set where an arm stands: that is a mistake, or an accident that the monitor
// would answer with a stop.
Result<void> Executive::Impl::change_objects(std::vector<CollisionObject> objects) {
  auto scene = scene_->with_objects(std::move(objects));
  if (!scene) return failure(std::move(scene.error()));
  ClearanceQuery query = monitored(*scene);
  for (const NearPair& closer : query.near_pairs(motions_.measured())) {
    const Proximity pair = query.describe(closer);
    if (!pair.object_b) continue;
    char text[256];
    std::snprintf(text, sizeof text, "%s would be %.4f m from %s as it stands now, limit %.4f m",
                  pair.body_b.c_str(), pair.clearance_m, pair.body_a.c_str(), pair.limit_m);
    return failure(Problem{ProblemKind::conflict, "object-in-arm", "", text, pair.clearance_m});
  }
  scene_ = std::move(*scene);
  clearance_query_ = std::move(query);
  watched_.resize(0);  // the monitor looks again, though no arm has moved
  ++scene_version_;
  tell(SceneView{scene_version_, scene_->objects()});
  step(SceneChanged{});
  return {};
}

Result<std::uint64_t> Executive::Impl::inject(const FaultRequest& request) {
  const auto arm = cell_->find_arm(request.arm);
  if (!arm) {
    return failure(Problem{ProblemKind::invalid, "unknown-arm", "/arm",
                           "no arm is named \"" + request.arm + "\"", request.arm});
  }
  ArmFault fault{
      .kind = request.kind, .from = request.at.value_or(now_), .until = {}, .value = request.value};
  if (request.lasting) fault.until = fault.from + *request.lasting;
  faulty_[arm->index()]->inject(next_fault_, fault);
  return next_fault_++;
}

Result<void> Executive::Impl::remove_fault(std::uint64_t id) {
  if (std::ranges::any_of(faulty_, [id](FaultyArm* arm) { return arm->remove(id); })) return {};
  return failure(Problem{ProblemKind::not_found, "unknown-fault", "",
                         "there is no fault " + std::to_string(id), static_cast<double>(id)});
}

}  // namespace armloom
