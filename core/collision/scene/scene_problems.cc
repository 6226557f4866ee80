#include "core/collision/scene/scene_problems.h"

#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>

namespace armloom {
namespace {

// Returns a problem if the mesh has no data. Mesh files are read when a cell is built, not here.
std::optional<Problem> mesh_problem(const Shape& shape, const std::string& pointer) {
  const auto* mesh = std::get_if<Mesh>(&shape);
  if (mesh == nullptr || mesh->data != nullptr) return std::nullopt;
  return Problem{ProblemKind::unsupported, "mesh-not-loaded", pointer,
                 "the mesh " + mesh->path + " has not been loaded", mesh->path};
}

std::optional<Problem> carrier_problem(const Cell& cell, LinkId id, const std::string& pointer) {
  if (id.index() >= cell.links.size()) {
    return Problem{ProblemKind::invalid, "unknown-link", pointer,
                   "the cell has no link " + std::to_string(id.index()),
                   std::to_string(id.index())};
  }
  const Link& link = cell.link(id);
  if (link.arm) return std::nullopt;
  return Problem{ProblemKind::invalid, "link-not-of-arm", pointer,
                 "no arm moves link " + link.name + ", so objects cannot be attached to it",
                 link.name};
}

}  // namespace

void find_link_problems(const Cell& cell, Problems& problems) {
  for (const Link& link : cell.links) {
    for (const PlacedShape& placed : link.shapes) {
      auto problem = mesh_problem(placed.shape, "link " + link.name);
      if (problem) problems.push_back(*std::move(problem));
    }
  }
}

void find_object_problems(const std::vector<CollisionObject>& objects,
                          const std::vector<Attachment>& held, Problems& problems) {
  std::unordered_map<std::string_view, std::size_t> names;  // index of the first of that name
  const auto is_held = [&](const std::string& name) {
    return std::ranges::any_of(held, [&](const Attachment& h) { return h.object.name == name; });
  };
  const auto place = [](std::size_t i) { return "/objects/" + std::to_string(i); };
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (std::holds_alternative<Mesh>(objects[i].shape)) {
      auto problem = mesh_problem(objects[i].shape, place(i) + "/mesh");
      if (problem) problems.push_back(*std::move(problem));
    }
    const std::string& name = objects[i].name;
    const bool taken = is_held(name);
    const auto [known, is_first] = names.emplace(name, i);
    if (is_first && !taken) continue;
    problems.push_back(
        {ProblemKind::conflict, "name-taken", place(i) + "/name",
         taken ? "an arm holds " + name + ": let a job detach it first, or give another name"
               : "objects " + std::to_string(known->second) + " and " + std::to_string(i) +
                     " are both named " + name + ": give each object its own name",
         name});
  }
}

// Called only when a scene is built from a cell, because a client may remove an object of the cell
// file later.
void find_unknown_allowed(const Cell& cell, Problems& problems) {
  std::set<std::string> names;
  for (const CollisionObject& object : cell.objects) names.insert(object.name);
  for (const auto& [link, object] : cell.allowed.link_objects) {
    if (names.contains(object)) continue;
    problems.push_back(
        {ProblemKind::invalid, "unknown-name", "/allowed_collisions",
         "no object is named " + object + ", but it is allowed to touch " + cell.link(link).name,
         object});
  }
}

void find_attachment_problems(const Cell& cell, const std::vector<CollisionObject>& objects,
                              const std::vector<Attachment>& attachments, Problems& problems) {
  std::map<std::string, std::string> taken;  // what each name already belongs to
  for (const Link& link : cell.links) taken.emplace(link.name, "a link");
  for (const CollisionObject& object : objects) taken.emplace(object.name, "an object");
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    const Attachment& held = attachments[i];
    const std::string pointer = "/attachments/" + std::to_string(i);
    const auto add = [&](std::optional<Problem> problem) {
      if (problem) problems.push_back(*std::move(problem));
    };
    add(mesh_problem(held.object.shape, pointer + "/object/mesh"));
    add(carrier_problem(cell, held.link, pointer + "/link"));
    for (std::size_t k = 0; k < held.others.size(); ++k) {
      add(carrier_problem(cell, held.others[k].link, pointer + "/others/" + std::to_string(k)));
    }
    for (std::size_t k = 0; k < held.touch.size(); ++k) {
      if (held.touch[k].index() < cell.links.size()) continue;
      add(carrier_problem(cell, held.touch[k], pointer + "/touch/" + std::to_string(k)));
    }
    const auto [known, fresh] = taken.emplace(held.object.name, "another attached object");
    if (fresh) continue;
    problems.push_back({ProblemKind::conflict, "name-taken", pointer + "/object/name",
                        known->second + " is already named " + held.object.name, held.object.name});
  }
}

}  // namespace armloom
