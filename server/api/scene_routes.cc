#include <algorithm>
#include <utility>

#include "server/api/routes.h"
#include "server/codec/cell_codec.h"

namespace armloom {
namespace {

using Arguments = Router::Arguments;

constexpr std::size_t kObjectsMax =
    1000;  // that clients may set into the scene, the cell's included

// What a change of the scene has come to.
struct Changed {
  std::uint64_t version;
  bool created;
};

bool is_known(const Executive& executive, const std::string& name) {
  return std::ranges::any_of(executive.objects(),
                             [&](const CollisionObject& object) { return object.name == name; });
}

Result<Changed> add(Executive& executive, const CollisionObject& object) {
  if (executive.objects().size() >= kObjectsMax) {
    return failure(Problem{
        ProblemKind::unavailable, "scene-full", "",
        "the scene holds " + std::to_string(kObjectsMax) + " objects already; take some away first",
        static_cast<double>(kObjectsMax)});
  }
  if (auto added = executive.add_object(object); !added) return failure(std::move(added.error()));
  return Changed{executive.scene_version(), true};
}

Result<Changed> put(Executive& executive, const CollisionObject& object) {
  if (!is_known(executive, object.name)) return add(executive, object);
  auto replaced = executive.replace_object(object);
  if (!replaced) return failure(std::move(replaced.error()));
  return Changed{executive.scene_version(), false};
}

void get_scene(const ApiParts& parts, Respond respond) {
  ask(
      parts,
      [](Executive& executive) {
        return SceneView{executive.scene_version(), executive.objects()};
      },
      [respond](const SceneView& scene) {
        JsonWriter out;
        out.begin_object().field("version", scene.version).key("objects");
        write_objects(out, scene.objects);
        out.end_object();
        respond(json_response(200, out.take()));
      });
}

// change: add or put, on the strand.
template <class Change>
void set_object(const ApiParts& parts, CollisionObject object, Change change, Respond respond) {
  const auto shared = std::make_shared<const CollisionObject>(std::move(object));
  ask(
      parts, [shared, change](Executive& executive) { return change(executive, *shared); },
      [respond, shared](const Result<Changed>& changed) {
        if (!changed) return respond(problem_response(changed.error()));
        JsonWriter out;
        out.begin_object().field("version", changed->version).key("object");
        write_object(out, *shared);
        out.end_object();
        Response response = json_response(changed->created ? 201 : 200, out.take());
        if (changed->created) {
          response.headers.emplace_back("Location",
                                        "/api/v1/scene/objects/" + url_segment(shared->name));
        }
        respond(std::move(response));
      });
}

void delete_object(const ApiParts& parts, const std::string& name, Respond respond) {
  ask(
      parts,
      [name](Executive& executive) -> Result<std::uint64_t> {
        if (auto done = executive.remove_object(name); !done) return failure(done.error());
        return executive.scene_version();
      },
      [respond](const Result<std::uint64_t>& version) {
        if (!version) return respond(problem_response(version.error()));
        JsonWriter out;
        out.begin_object().field("version", *version).end_object();
        respond(json_response(200, out.take()));
      });
}

}  // namespace

void add_scene_routes(Router& router, const ApiParts& parts) {
  const std::string scene = kApi + std::string("/scene");
  router.add("GET", scene, [&parts](const Request&, const Arguments&, Respond respond) {
    get_scene(parts, std::move(respond));
  });
  router.add("POST", scene + "/objects",
             [&parts](const Request& request, const Arguments&, Respond respond) {
               auto object = read_body(
                   request, [](std::string_view text) { return read_object_text(text, {}); });
               if (!object) return respond(problem_response(object.error()));
               set_object(parts, std::move(*object), add, std::move(respond));
             });
  router.add("PUT", scene + "/objects/{}",
             [&parts](const Request& request, const Arguments& arguments, Respond respond) {
               auto object = read_body(request, [&](std::string_view text) {
                 return read_object_text(text, arguments.front());
               });
               if (!object) return respond(problem_response(object.error()));
               set_object(parts, std::move(*object), put, std::move(respond));
             });
  router.add("DELETE", scene + "/objects/{}",
             [&parts](const Request&, const Arguments& arguments, Respond respond) {
               delete_object(parts, arguments.front(), std::move(respond));
             });
}

}  // namespace armloom
