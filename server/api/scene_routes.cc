#include <algorithm>
#include <utility>

#include "core/executive/status_board.h"
#include "server/api/route.h"
#include "server/messages/scene.h"

namespace armloom {
namespace {

constexpr std::size_t kObjectsMax = 1000;  // including those of the cell file

struct Changed {
  std::uint64_t version;
  bool created;
};

Result<Changed> add(Executive& executive, const CollisionObject& object) {
  if (executive.scene().objects().size() >= kObjectsMax) {
    return failure(Problem{ProblemKind::unavailable, "scene-full", "",
                           "the scene holds " + std::to_string(kObjectsMax) +
                               " objects, the maximum: remove some first",
                           static_cast<double>(kObjectsMax)});
  }
  if (auto added = executive.scene().add(object); !added) return failure(std::move(added.error()));
  return Changed{executive.scene().version(), true};
}

Result<Changed> put(Executive& executive, const CollisionObject& object) {
  if (!has_object(executive.scene().objects(), object.name)) return add(executive, object);
  auto replaced = executive.scene().replace(object);
  if (!replaced) return failure(std::move(replaced.error()));
  return Changed{executive.scene().version(), false};
}

void get_scene(Call call) {
  call.respond(answer(200, scene_format(), *call.parts.loop.board().read().scene));
}

// Answers when the change is stored. `text`: the object as the client sent it, or nullopt if it was
// removed.
void respond_when_stored(const ApiParts& parts, const std::string& name,
                         std::optional<std::string> text, const Respond& respond,
                         Response response) {
  if (parts.keeper == nullptr) return respond(std::move(response));
  parts.keeper->change({name, std::move(text), has_object(parts.cell->objects, name)},
                       [respond, response = std::move(response)](std::optional<Refusal> refusal) {
                         respond(refusal ? done_but_not_stored(*std::move(refusal)) : response);
                       });
}

// Adds or replaces an object with `change`, which is add or put. `name`: name of the object in the
// path, if any.
template <class Change>
void set_object(Call& call, const std::optional<std::string>& name, Change change) {
  const auto set = [&parts = call.parts, respond = call.respond, text = call.request.body,
                    change](CollisionObject object) {
    const auto shared = std::make_shared<const CollisionObject>(std::move(object));
    ask(
        parts, [shared, change](Executive& executive) { return change(executive, *shared); },
        [&parts, respond, text, shared](const Result<Changed>& changed) {
          if (!changed) return respond(problem_response(changed.error()));
          Response told = answer(changed->created ? 201 : 200, scene_change_format(),
                                 SceneChange{changed->version, *shared});
          if (changed->created) {
            told = located(std::move(told), "/scene/objects/" + url_segment(shared->name));
          }
          respond_when_stored(parts, shared->name, *text, respond, std::move(told));
        });
  };
  read_body(
      call.parts, call.request, call.respond,
      [name](std::string_view text) { return read_object_text(text, name); }, set);
}

void post_object(Call call) { set_object(call, std::nullopt, add); }
void put_object(Call call) { set_object(call, call.arguments.front(), put); }

// Removes an object. Refuses to do so while the removal cannot be stored.
void delete_object(Call call) {
  if (const auto refusal = refusal_of_store(call.parts)) {
    return call.respond(refusal_response(*refusal));
  }
  ask(
      call.parts,
      [name = call.arguments.front()](Executive& executive) -> Result<std::uint64_t> {
        if (auto done = executive.scene().remove(name); !done) return failure(done.error());
        return executive.scene().version();
      },
      [&parts = call.parts, respond = call.respond,
       name = call.arguments.front()](const Result<std::uint64_t>& version) {
        if (!version) return respond(problem_response(version.error()));
        respond_when_stored(parts, name, std::nullopt, respond,
                            answer(200, scene_version_format(), *version));
      });
}

}  // namespace

std::vector<Route> scene_routes() {
  const std::string objects = api_path("/scene/objects");
  return {
      {.method = "GET",
       .path = api_path("/scene"),
       .id = "getScene",
       .tag = "scene",
       .summary = "Get the objects of the scene",
       .outcomes = {outcome(200, "The objects and the version of the scene", scene_format())},
       .run = get_scene},
      {.method = "POST",
       .path = objects,
       .id = "addObject",
       .tag = "scene",
       .summary = "Add an object",
       .text = "409 if the name is in use, or if the object would overlap an arm.",
       .reads = body(object_request_format(),
                     {{"rod", R"({"name": "rod", "cylinder": [0.015, 0.5], "xyz": [0, 0.9, 0.4], )"
                              R"("rpy": [0, 0, 0]})"}}),
       .outcomes = {created(201, "The object is added and all motions are checked against it",
                            scene_change_format())},
       .refuses = {409, 422, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = post_object},
      {.method = "PUT",
       .path = objects + "/{name}",
       .id = "putObject",
       .tag = "scene",
       .summary = "Create or replace an object",
       .reads = body(named_object_request_format(),
                     {{"box", R"({"box": [0.1, 0.1, 0.1], "xyz": [0, 0.9, 0.2]})"}}),
       .outcomes = {outcome(200, "The object is replaced", scene_change_format()),
                    created(201, "The object is created", scene_change_format())},
       .refuses = {409, 422, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = put_object},
      {.method = "DELETE",
       .path = objects + "/{name}",
       .id = "removeObject",
       .tag = "scene",
       .summary = "Remove an object",
       .outcomes = {outcome(200, "The object is removed", scene_version_format())},
       .refuses = {404, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = delete_object},
  };
}

}  // namespace armloom
