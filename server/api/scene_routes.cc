#include <algorithm>
#include <utility>
#include <variant>

#include "core/executive/status_board.h"
#include "server/api/job_answers.h"
#include "server/api/route.h"
#include "server/http/entity_tag.h"
#include "server/messages/scene.h"
#include "server/messages/stored_scene.h"

namespace armloom {
namespace {

using Answered = std::function<void(const Result<SceneEdited>&)>;

Response tagged(Response response, std::uint64_t version) {
  response.headers.emplace_back("ETag", '"' + std::to_string(version) + '"');
  return response;
}

void get_scene(Call call) {
  const auto scene = call.parts.loop.board().read().scene;
  call.respond(tagged(answer(200, scene_format(), *scene), scene->version));
}

// Edits the scene, then calls `then` on the server's thread.
void edit(const ApiParts& parts, SceneEdit edit, RealTimeLoop::ObjectsTo objects_to,
          Answered then) {
  parts.loop.edit_scene(std::move(edit), std::move(objects_to),
                        [&parts, then = std::move(then)](const Result<SceneEdited>& edited) {
                          parts.post([then, edited = std::make_shared<const Result<SceneEdited>>(
                                                edited)] { then(*edited); });
                        });
}

bool is_of_cell(const ApiParts& parts, const std::string& name) {
  return has_object(parts.cell->objects, name);
}

// Answers when the changes are stored.
void respond_when_stored(const ApiParts& parts, std::vector<StoredObject> objects,
                         const Respond& respond, Response response) {
  if (parts.keeper == nullptr) return respond(std::move(response));
  parts.keeper->change(std::move(objects), when_stored(respond, std::move(response)));
}

// ---- Single objects ----

// Adds the object of the body, or puts it. `name`: name of the object in the path, if any.
template <class Edit>
void set_object(Call& call, const std::optional<std::string>& name) {
  // The object, and its text as JSON.
  using Read = std::pair<CollisionObject, std::string>;
  const auto set = [&parts = call.parts, respond = call.respond](const Read& read) {
    const auto& [object, text] = read;
    edit(parts, Edit{object}, nullptr,
         [&parts, respond, text = text, object = object](const Result<SceneEdited>& edited) {
           if (!edited) return respond(problem_response(edited.error()));
           Response told = answer(edited->created ? 201 : 200, scene_change_format(),
                                  SceneChange{edited->version, object});
           if (edited->created) {
             told = located(std::move(told), "/scene/objects/" + url_segment(object.name));
           }
           respond_when_stored(parts, {{object.name, text, is_of_cell(parts, object.name)}},
                               respond, std::move(told));
         });
  };
  read_body(
      call.parts, call.request, call.respond,
      [name](std::string_view text) -> Result<Read> {
        auto object = read_object_text(text, name);
        if (!object) return failure(std::move(object.error()));
        return Read(*std::move(object), text);
      },
      set);
}

void post_object(Call call) { set_object<ObjectAdded>(call, std::nullopt); }
void put_object(Call call) { set_object<ObjectPut>(call, call.arguments.front()); }

// Removes an object. Refuses to do so while the removal cannot be stored.
void delete_object(Call call) {
  if (const auto refusal = refusal_of_store(call.parts)) {
    return call.respond(refusal_response(*refusal));
  }
  const std::string& name = call.arguments.front();
  edit(call.parts, ObjectRemoved{name}, nullptr,
       [&parts = call.parts, respond = call.respond, name](const Result<SceneEdited>& edited) {
         if (!edited) return respond(problem_response(edited.error()));
         respond_when_stored(parts, {{name, std::nullopt, is_of_cell(parts, name)}}, respond,
                             answer(200, scene_version_format(), edited->version));
       });
}

// The arm lets go of an object, which stays where it is.
void detach_object(Call call) {
  if (const auto refusal = refusal_of_store(call.parts)) {
    return call.respond(refusal_response(*refusal));
  }
  struct Detached {
    std::uint64_t version;
    CollisionObject object;
  };
  ask(
      call.parts,
      [name = call.arguments.front()](Executive& executive) -> Result<Detached> {
        auto placed = executive.detach(name);
        if (!placed) return failure(std::move(placed.error()));
        return Detached{executive.scene().version(), *std::move(placed)};
      },
      [&parts = call.parts, respond = call.respond](const Result<Detached>& done) {
        if (!done) return respond(problem_response(done.error()));
        const CollisionObject& object = done->object;
        respond_when_stored(
            parts, {{object.name, text_of_place({object}), is_of_cell(parts, object.name)}},
            respond, answer(200, scene_change_format(), SceneChange{done->version, object}));
      });
}

// ---- All objects at once ----

constexpr const char* kVersionDiffers = "scene-changed";

// Objects to a scene that has another version than the client expects.
RealTimeLoop::ObjectsTo unless_as_expected(const IfMatch& if_match,
                                           std::optional<std::uint64_t> expected) {
  if (!if_match && !expected) return nullptr;
  return [if_match, expected](std::uint64_t version) -> std::optional<Problem> {
    const std::string mine = '"' + std::to_string(version) + '"';
    const auto is_mine = [&](std::string_view tag) { return tag == "*" || tag == mine; };
    const bool differs = if_match && !any_tag(*if_match, is_mine);
    if (!differs && (!expected || *expected == version)) return std::nullopt;
    return Problem{ProblemKind::conflict, kVersionDiffers, differs ? "If-Match" : "/version",
                   "the scene has version " + std::to_string(version) +
                       ", so it has changed: fetch it again with GET /scene",
                   differs ? *if_match : std::to_string(*expected)};
  };
}

Response refused_edit(const Problems& problems) {
  const Problem& first = problems.front();
  if (first.slug != kVersionDiffers || first.pointer != "If-Match") {
    return problem_response(problems);
  }
  return refusal_response({412, "precondition-failed", first.detail, first.pointer,
                           std::get<std::string>(first.value)});
}

// Sets all objects. `texts`: of the objects, as JSON.
void set_scene(const ApiParts& parts, const Respond& respond, const ObjectsSet& all,
               std::vector<std::string> texts, RealTimeLoop::ObjectsTo objects_to) {
  edit(parts, all, std::move(objects_to),
       [&parts, respond, all, texts = std::move(texts)](const Result<SceneEdited>& edited) {
         if (!edited) return respond(refused_edit(edited.error()));
         std::vector<StoredObject> stored;
         if (parts.keeper != nullptr) {
           const bool expire = edited->expiry.names != nullptr;
           const std::int64_t expires_ms =
               expire ? since_1970_ms(parts.keeper->clock().wall_at(edited->expiry.at)) : 0;
           for (std::size_t i = 0; i < all.objects->size(); ++i) {
             const std::string& name = (*all.objects)[i].name;
             const bool of_cell = is_of_cell(parts, name);
             stored.push_back(
                 {name, expire && !of_cell ? text_with_expiry(texts[i], expires_ms) : texts[i],
                  of_cell});
           }
           for (const std::string& name : edited->removed) stored.push_back({.name = name});
         }
         respond_when_stored(
             parts, std::move(stored), respond,
             tagged(answer(200, scene_version_format(), edited->version), edited->version));
       });
}

// Refuses an invalid If-Match, and a removal that cannot be stored.
std::optional<Response> refusal_of(const Call& call) {
  if (auto bad = bad_if_match(call.request)) return bad;
  if (const auto refusal = refusal_of_store(call.parts)) return refusal_response(*refusal);
  return std::nullopt;
}

void put_scene(Call call) {
  if (const auto refusal = refusal_of(call)) return call.respond(*refusal);
  read_body(call.parts, call.request, call.respond, read_scene_text,
            [&parts = call.parts, respond = call.respond,
             if_match = call.request.if_match](ReadScene scene) {
              set_scene(parts, respond, {scene.objects, scene.expires_in}, std::move(scene.texts),
                        unless_as_expected(if_match, scene.version));
            });
}

void delete_objects(Call call) {
  if (const auto refusal = refusal_of(call)) return call.respond(*refusal);
  set_scene(call.parts, call.respond,
            {.objects = std::make_shared<const std::vector<CollisionObject>>()}, {},
            unless_as_expected(call.request.if_match, std::nullopt));
}

Parameter scene_if_match() {
  return {"If-Match",
          "`ETag` of the scene as the client read it; 412 if the scene was changed since",
          {{"type", "string"}},
          false,
          "header"};
}

Outcome with_tag(Outcome outcome) {
  outcome.has_tag = true;
  return outcome;
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
       .outcomes = {with_tag(
           outcome(200, "The objects and the version of the scene", scene_format()))},
       .run = get_scene},
      {.method = "PUT",
       .path = api_path("/scene"),
       .id = "putScene",
       .tag = "scene",
       .summary = "Set all objects at once",
       .text =
           "One change for thousands of objects, such as those of a camera: all or none. Objects "
           "that clients had added and that are not in the body are removed. Objects of the cell "
           "file stay, unless the body has an object of their name. 409 if an object would "
           "overlap an arm, if a name is in use, or if `version` is not the scene's. With "
           "`padding_m`, all objects are enlarged; with `expires_in_s`, they are removed after "
           "this time unless they are set again.",
       .parameters = {scene_if_match()},
       .reads = body(scene_request_format(),
                     {{"voxels", R"({"objects": [{"name": "v1", "box": [0.04, 0.04, 0.04], )"
                                 R"("xyz": [0, 0.9, 0.2]}, {"name": "v2", )"
                                 R"("box": [0.04, 0.04, 0.04], "xyz": [0, 0.9, 0.3]}], )"
                                 R"("padding_m": 0.01, "expires_in_s": 2.5})"}}),
       .outcomes = {with_tag(outcome(200, "The scene is set and all motions are checked against it",
                                     scene_version_format()))},
       .refuses = {400, 409, 412, 422, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = put_scene},
      {.method = "DELETE",
       .path = objects,
       .id = "removeObjects",
       .tag = "scene",
       .summary = "Remove all objects that clients have added",
       .text = "Objects of the cell file stay as they are.",
       .parameters = {scene_if_match()},
       .outcomes = {with_tag(outcome(200, "The objects are removed", scene_version_format()))},
       .refuses = {400, 412, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = delete_objects},
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
       .refuses = {404, 409, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = delete_object},
      {.method = "POST",
       .path = objects + "/{name}/detach",
       .id = "detachObject",
       .tag = "scene",
       .summary = "Let go of an object that an arm holds",
       .text = "The object is part of the scene from now on, where it is; the arm may still touch "
               "it until it has left it. The gripper does not move. Afterwards, the object can be "
               "replaced or removed. 409 if no arm holds it, if the arm moves, or if a job with "
               "steps that has begun uses the arm.",
       .outcomes = {outcome(200, "The object is part of the scene", scene_change_format())},
       .refuses = {404, 409, 507},
       .who = Who::commander,
       .role = Role::operate,
       .run = detach_object},
  };
}

}  // namespace armloom
