#include "core/executive/live_scene.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/executive/executive_input.h"
#include "core/executive/holding.h"
#include "core/executive/state_watch.h"

namespace armloom {
namespace {

using Objects = std::vector<CollisionObject>;

auto named(const std::string& name) {
  return [&name](const CollisionObject& object) { return object.name == name; };
}

// Links and objects share one set of names, because conflicts and allowed pairs name both.
std::optional<Problem> taken_in_cell(const std::string& name, const Cell& cell,
                                     const std::string& place) {
  const auto has_name = [&name](const auto& part) { return part.name == name; };
  const char* whose = std::ranges::any_of(cell.links, has_name)    ? "link"
                      : std::ranges::any_of(cell.robots, has_name) ? "robot"
                                                                   : nullptr;
  if (whose == nullptr) return std::nullopt;
  return Problem{ProblemKind::conflict, "name-taken", place + "/name",
                 "a " + std::string(whose) + " is named \"" + name +
                     "\" already: give the object another name",
                 name};
}

// Returns a conflict if an arm holds the object.
std::optional<Problem> held_in(const std::string& name, const PlanningScene& base, const char* slug,
                               std::string pointer) {
  const auto carrier = carrier_of(base, name);
  if (!carrier) return std::nullopt;
  return Problem{ProblemKind::conflict, slug, std::move(pointer),
                 base.cell().link(*carrier).name + " holds \"" + name +
                     "\": let go of it first with POST /scene/objects/" + name + "/detach",
                 name};
}

Problem not_placed(const std::string& name, const PlanningScene& base) {
  return held_in(name, base, "is-held", "").value_or(no_object(name));
}

Problem scene_full(std::size_t count) {
  return Problem{ProblemKind::unavailable, "scene-full", "",
                 "the scene would hold " + std::to_string(count) + " objects, the maximum is " +
                     std::to_string(kObjectsMax) +
                     ": remove some first, or send fewer and larger boxes",
                 static_cast<double>(count)};
}

// The objects after an edit, and what changes.
struct Outline {
  Objects objects;
  std::vector<std::string> changed = {};
  std::vector<std::string> removed = {};
  std::vector<std::string> expiring = {};
};

Result<Outline> outline(const ObjectAdded& edit, const PlanningScene& base) {
  const std::string& name = edit.object.name;
  if (auto taken = taken_in_cell(name, base.cell(), "")) return failure(std::move(*taken));
  if (std::ranges::any_of(base.objects(), named(name))) {
    return failure(Problem{ProblemKind::conflict, "name-taken", "/name",
                           "an object is named \"" + name +
                               "\" already: replace it with PUT /scene/objects/{name}, or give "
                               "another name",
                           name});
  }
  if (auto held = held_in(name, base, "name-taken", "/name")) return failure(*std::move(held));
  Outline after{base.objects(), {name}};
  after.objects.push_back(edit.object);
  return after;
}

Result<Outline> outline(const ObjectReplaced& edit, const PlanningScene& base) {
  Outline after{base.objects(), {edit.object.name}};
  const auto old = std::ranges::find_if(after.objects, named(edit.object.name));
  if (old == after.objects.end()) return failure(not_placed(edit.object.name, base));
  *old = edit.object;
  return after;
}

Result<Outline> outline(const ObjectRemoved& edit, const PlanningScene& base) {
  Outline after{base.objects(), {}, {edit.name}};
  if (std::erase_if(after.objects, named(edit.name)) == 0)
    return failure(not_placed(edit.name, base));
  return after;
}

bool is_same(const CollisionObject& a, const CollisionObject& b) {
  return a.shape == b.shape && a.X_WO.matrix() == b.X_WO.matrix() && a.mass == b.mass;
}

Result<Outline> outline(const ObjectsSet& edit, const PlanningScene& base) {
  const Objects& given = *edit.objects;
  Problems problems;
  std::unordered_map<std::string_view, std::size_t> index;  // in `given`
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string place = "/objects/" + std::to_string(i);
    auto taken = taken_in_cell(given[i].name, base.cell(), place);
    if (!taken) taken = held_in(given[i].name, base, "name-taken", place + "/name");
    if (taken) problems.push_back(std::move(*taken));
    const auto [first, is_first] = index.emplace(given[i].name, i);
    if (is_first) continue;
    problems.push_back({ProblemKind::conflict, "name-taken", place + "/name",
                        "object " + std::to_string(first->second) + " is named \"" + given[i].name +
                            "\" already: give each object its own name",
                        given[i].name});
  }
  if (!problems.empty()) return failure(std::move(problems));

  std::unordered_set<std::string_view> of_cell;
  for (const CollisionObject& object : base.cell().objects) of_cell.insert(object.name);
  std::vector<bool> is_placed(given.size(), false);
  Outline after;
  for (const CollisionObject& object : base.objects()) {
    const auto by = index.find(object.name);
    if (by == index.end()) {
      of_cell.contains(object.name) ? after.objects.push_back(object)
                                    : after.removed.push_back(object.name);
      continue;
    }
    const CollisionObject& next = given[by->second];
    is_placed[by->second] = true;
    if (!is_same(object, next)) after.changed.push_back(next.name);
    after.objects.push_back(next);
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (is_placed[i]) continue;
    after.changed.push_back(given[i].name);
    after.objects.push_back(given[i]);
  }
  std::ranges::sort(after.changed);
  if (!edit.expires_in) return after;
  for (const auto& [name, place] : index) {
    if (!of_cell.contains(name)) after.expiring.emplace_back(name);
  }
  std::ranges::sort(after.expiring);
  return after;
}

Result<Outline> outline(const ObjectsExpired& edit, const PlanningScene& base) {
  const std::unordered_set<std::string_view> names(edit.names.begin(), edit.names.end());
  Outline after;
  for (const CollisionObject& object : base.objects()) {
    if (names.contains(object.name)) {
      after.removed.push_back(object.name);
    } else {
      after.objects.push_back(object);
    }
  }
  return after;
}

Result<Outline> outline(const ObjectPut&, const PlanningScene&) {
  throw std::logic_error("ObjectPut: prepare() has made it ObjectAdded or ObjectReplaced");
}

Result<PreparedEdit::Made> make(const SceneEdit& edit, const PlanningScene& base) {
  auto after = std::visit([&](const auto& kind) { return outline(kind, base); }, edit);
  if (!after) return failure(std::move(after.error()));
  const std::size_t count = after->objects.size();
  if (count > kObjectsMax && count > base.objects().size()) return failure(scene_full(count));
  auto scene = base.with_objects(std::move(after->objects));
  if (!scene) return failure(std::move(scene.error()));
  auto query = std::make_unique<ClearanceQuery>(StateWatch::query_of(*scene));
  std::shared_ptr<const std::vector<std::string>> expiring;
  if (!after->expiring.empty()) {
    expiring = std::make_shared<const std::vector<std::string>>(std::move(after->expiring));
  }
  return PreparedEdit::Made{std::move(*scene), std::move(query), std::move(after->changed),
                            std::move(after->removed), std::move(expiring)};
}

ExecutiveInput input_of(const SceneEdit& edit) {
  return std::visit(
      [](const auto& kind) -> ExecutiveInput {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, ObjectPut>) {
          throw std::logic_error("ObjectPut is not logged");
        } else {
          return {kind};
        }
      },
      edit);
}

// Returns the JSON pointer of the object in the request.
std::string place_of(const SceneEdit& edit, const std::string& name) {
  const auto* set = std::get_if<ObjectsSet>(&edit);
  if (set == nullptr) return "";
  const auto found = std::ranges::find_if(*set->objects, named(name));
  return "/objects/" + std::to_string(found - set->objects->begin());
}

}  // namespace

PreparedEdit prepare(SceneEdit edit, const PlanningScenePtr& base) {
  if (auto* put = std::get_if<ObjectPut>(&edit)) {
    CollisionObject object = std::move(put->object);
    if (std::ranges::any_of(base->objects(), named(object.name))) {
      edit = ObjectReplaced{std::move(object)};
    } else {
      edit = ObjectAdded{std::move(object)};
    }
  }
  auto made = make(edit, *base);
  return {base, std::move(edit), std::move(made)};
}

// Returns a problem if an object is set where an arm is: a mistake, or an accident that the monitor
// would answer with a stop.
std::optional<Problem> LiveScene::object_in_arm(const PreparedEdit& prepared) const {
  if (prepared.made->changed.empty()) return std::nullopt;
  ClearanceQuery& query = *prepared.made->query;
  for (const NearPair& closer : query.near_pairs(measured_())) {
    const Proximity pair = query.describe(closer);
    if (!pair.object_b || !std::ranges::binary_search(prepared.made->changed, pair.body_b))
      continue;
    char figures[96];
    std::snprintf(figures, sizeof figures, pair.clearance_m < 0.0 ? "overlap " : "be %.4f m from ",
                  pair.clearance_m);
    std::string text = pair.body_b + " would " + figures + pair.body_a + " at its present position";
    if (pair.clearance_m < 0.0) text += " by " + in_mm(pair.clearance_m);
    std::snprintf(figures, sizeof figures, ", limit %.4f m", pair.limit_m);
    return Problem{ProblemKind::conflict, "object-in-arm", place_of(prepared.edit, pair.body_b),
                   text + figures + ": move the arm first, or leave the object out",
                   pair.clearance_m};
  }
  return std::nullopt;
}

Result<SceneEdited> LiveScene::apply(PreparedEdit& prepared) {
  if (auto* expired = std::get_if<ObjectsExpired>(&prepared.edit)) {
    auto due_now = due(told_.now());
    if (!due_now) return SceneEdited{.version = now_.version, .created = false, .removed = {}};
    if (due_now->names != expired->names) prepared = prepare(std::move(*due_now), now_.scene);
  }
  if (prepared.base != now_.scene) prepared = prepare(std::move(prepared.edit), now_.scene);
  told_.asked(input_of(prepared.edit));
  if (!prepared.made) return failure(prepared.made.error());
  if (auto problem = object_in_arm(prepared)) return failure(std::move(*problem));
  std::swap(now_.scene, prepared.made->scene);
  ++now_.version;
  take_expiry(prepared);
  told_.changed(*prepared.made->query);
  return SceneEdited{now_.version, std::holds_alternative<ObjectAdded>(prepared.edit),
                     std::move(prepared.made->removed), expiry_};
}

// ---- Expiry ----

std::optional<ObjectsExpired> LiveScene::due(TimePoint now) const {
  if (expiry_.names == nullptr || now < expiry_.at) return std::nullopt;
  return ObjectsExpired{*expiry_.names};
}

const std::vector<std::string>& LiveScene::expired() const {
  static const std::vector<std::string> kNone;
  return version_of_expiry_ == now_.version ? expired_ : kNone;
}

void LiveScene::take_expiry(const PreparedEdit& prepared) {
  if (const auto* set = std::get_if<ObjectsSet>(&prepared.edit)) {
    expiry_ = {};
    const auto& names = prepared.made->expiring;
    if (set->expires_in && names) expiry_ = {told_.now() + *set->expires_in, names};
  } else if (std::holds_alternative<ObjectsExpired>(prepared.edit)) {
    expiry_ = {};
    expired_ = prepared.made->removed;
    version_of_expiry_ = version_of_change_ = now_.version;
  } else {
    for (const auto* names : {&prepared.made->changed, &prepared.made->removed}) {
      for (const std::string& name : *names) never_expires(name);
    }
  }
}

void LiveScene::never_expires(const std::string& name) {
  if (expiry_.names == nullptr || !std::ranges::binary_search(*expiry_.names, name)) return;
  std::vector<std::string> names = *expiry_.names;
  std::erase(names, name);
  expiry_.names = std::make_shared<const std::vector<std::string>>(std::move(names));
  if (expiry_.names->empty()) expiry_ = {};
}

void LiveScene::restore(SceneExpiry expiry) {
  told_.asked({expiry});
  std::vector<std::string> names;
  for (const CollisionObject& object : objects()) {
    if (expiry.names && std::ranges::binary_search(*expiry.names, object.name)) {
      names.push_back(object.name);
    }
  }
  std::ranges::sort(names);
  if (names.empty()) return;
  expiry_ = {expiry.at, std::make_shared<const std::vector<std::string>>(std::move(names))};
  ClearanceQuery query = StateWatch::query_of(now_.scene);
  ++now_.version;
  told_.changed(query);
}

// ---- Other changes ----

Result<void> LiveScene::change(PlanningScene::Content content) {
  auto made = now_.scene->with(std::move(content));
  if (!made) return failure(std::move(made.error()));
  ClearanceQuery query = StateWatch::query_of(*made);
  now_.scene = std::move(*made);
  for (const Attachment& held : now_.scene->attachments()) never_expires(held.object.name);
  version_of_change_ = ++now_.version;
  told_.changed(query);
  return {};
}

Result<void> LiveScene::hold(const HeldView& held) {
  told_.asked({held});
  auto next = attachment_of(now_.scene->cell(), held);
  if (!next) return failure(std::move(next.error()));
  return change(holding(*now_.scene, *std::move(next)));
}

Result<void> LiveScene::edit(SceneEdit edit) {
  PreparedEdit prepared = prepare(std::move(edit), now_.scene);
  if (auto done = apply(prepared); !done) return failure(std::move(done.error()));
  return {};
}

Result<void> LiveScene::add(CollisionObject object) { return edit(ObjectAdded{std::move(object)}); }
Result<void> LiveScene::replace(CollisionObject object) {
  return edit(ObjectReplaced{std::move(object)});
}
Result<void> LiveScene::remove(const std::string& name) { return edit(ObjectRemoved{name}); }
Result<void> LiveScene::set(std::vector<CollisionObject> objects) {
  return edit(ObjectsSet{std::make_shared<const Objects>(std::move(objects))});
}

}  // namespace armloom
