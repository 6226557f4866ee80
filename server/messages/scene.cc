#include "server/messages/scene.h"

#include <algorithm>
#include <utility>

#include "core/base/plain_name.h"
#include "core/executive/live_scene.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/scene_format.h"
#include "server/codec/value_formats.h"
#include "server/messages/mesh_address.h"

namespace armloom {

using namespace formats;

namespace {

FormatPtr<std::string> object_name_format() {
  return text(TextRule{is_plain_name,
                       "bad-name",
                       kPlainNameRule,
                       {{"minLength", 1},
                        {"maxLength", kPlainNameMax},
                        {"pattern", R"(^[^\u0000-\u001f\u007f/\\]*$)"},
                        {"not", {{"enum", {".", ".."}}}}}});
}

FormatPtr<ObjectDescription> make_object_format(Need name) {
  return object<ObjectDescription>({
      member({"name",
              "Name of at most 128 characters; no slash, backslash or control character, not . or "
              ".., and not the name of a link or robot",
              name,
              {}},
             &ObjectDescription::name, object_name_format()),
      not_served<ObjectDescription>({"mesh", "unsupported",
                                     "a mesh can be given in the cell file only; give a box, a "
                                     "cylinder or a sphere. PUT /scene "
                                     "keeps the meshes of the cell file if they are left out"}),
      unless("mesh", inlined(&ObjectDescription::shape, primitive_part())),
      inlined(&ObjectDescription::X_WO, pose_part()),
      inlined(&ObjectDescription::mass, mass_part()),
  });
}

class CollisionObjectFormat final : public CustomFormat<CollisionObject> {
 public:
  void read(const JsonNode& node, CollisionObject& object) const override {
    ObjectDescription description;
    object_request_format()->read(node, description);
    object = {std::move(description.name), description.shape, description.X_WO, description.mass};
  }
  void write(JsonWriter& out, const CollisionObject& object) const override {
    ObjectDescription description{object.name, object.shape, object.X_WO, object.mass};
    if (auto* mesh = std::get_if<Mesh>(&description.shape)) mesh->path = mesh_address(mesh->path);
    scene_object_format()->write(out, description);
  }
  Schema schema(Way way) const override { return scene_object_format()->schema(way); }
};

}  // namespace

FormatPtr<ObjectDescription> object_request_format() {
  static const auto format = named("ObjectRequest",
                                   "An object as in the cell file, with exactly one shape. Meshes "
                                   "are not allowed. Default pose: zero.",
                                   make_object_format(Need::required));
  return format;
}

FormatPtr<ObjectDescription> named_object_request_format() {
  static const auto format =
      named("NamedObjectRequest",
            "The members of ObjectRequest. The name is in the path; it may be repeated here.",
            make_object_format(Need::optional));
  return format;
}

FormatPtr<SceneRequest> scene_request_format() {
  using Request = SceneRequest;
  static const auto format =
      named("SceneRequest",
            "All objects of the scene, as GET /scene returns them. Objects of the cell file that "
            "are left "
            "out stay as they are; all others are removed.",
            object<Request>({
                required("objects", &Request::objects,
                         list(object_request_format(), {.most = kObjectsMax, .noun = "objects"}),
                         "The objects; a name of an object of the cell file replaces that object"),
                ignored<Request>("held", anything("array"),
                                 "Ignored: steps of jobs attach and detach objects"),
                ignored<Request>("touch", anything("array"), "Ignored, as `held`"),
                ignored<Request>("expires_s", number(kAnyNumber), "Ignored: see `expires_in_s`"),
                ignored<Request>("expiring", anything("array"), "Ignored: see `expires_in_s`"),
                ignored<Request>("expired", anything("array"), "Ignored: see `expires_in_s`"),
                field("version", &Request::version, count(),
                      "Version that the scene must have, as in GET /scene; 409 if it has another "
                      "version. Default: any version"),
                omit_default(
                    "padding_m", &Request::padding_m, 0.0, number(Request::padding_range),
                    "Distance by which all objects of this request are enlarged, in meters: the "
                    "sides of a box and the surface and ends of a cylinder or sphere move outward. "
                    "GET /scene returns the enlarged objects"),
                field("expires_in_s", &Request::expires_in, seconds(Request::expires_in_range),
                      "Time after which the objects of this request are removed, in seconds of "
                      "cell time from the change on, unless they are set again before. Objects of "
                      "the cell file never expire. Default: never"),
            }));
  return format;
}

namespace {

constexpr double kEnlargedMax = 1000.0;  // m, as of objects that are requested

struct Enlarge {
  double padding_m;
  void operator()(Box& box) const { box.size_m.array() += 2.0 * padding_m; }
  void operator()(Cylinder& cylinder) const {
    cylinder.radius_m += padding_m;
    cylinder.length_m += 2.0 * padding_m;
  }
  void operator()(Sphere& sphere) const { sphere.radius_m += padding_m; }
  void operator()(Mesh&) const { throw std::logic_error("requests have no meshes"); }
};

// Replaces the shape in the text of an object. Returns its largest length (m).
struct InText {
  nlohmann::json& object;
  double operator()(const Box& box) const {
    object["box"] = {box.size_m.x(), box.size_m.y(), box.size_m.z()};
    return box.size_m.maxCoeff();
  }
  double operator()(const Cylinder& cylinder) const {
    object["cylinder"] = {cylinder.radius_m, cylinder.length_m};
    return std::max(cylinder.radius_m, cylinder.length_m);
  }
  double operator()(const Sphere& sphere) const {
    object["sphere"] = {sphere.radius_m};
    return sphere.radius_m;
  }
  double operator()(const Mesh&) const { throw std::logic_error("requests have no meshes"); }
};

void enlarge(SceneRequest& request, nlohmann::json& objects, Problems& faults) {
  if (request.padding_m == 0.0) return;
  for (std::size_t i = 0; i < request.objects.size(); ++i) {
    Shape& shape = request.objects[i].shape;
    std::visit(Enlarge{request.padding_m}, shape);
    const double largest_m = std::visit(InText{objects[i]}, shape);
    if (largest_m <= kEnlargedMax) continue;
    faults.push_back({ProblemKind::invalid, "out-of-range", "/objects/" + std::to_string(i),
                      "with padding_m, the object has a length of " + std::to_string(largest_m) +
                          " m, limit 1000 m: make it smaller",
                      largest_m});
  }
}

}  // namespace

Result<ReadScene> read_scene_text(std::string_view text) {
  auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  SceneRequest request;
  scene_request_format()->read(JsonNode(*body, "", faults), request);
  if (faults.empty()) enlarge(request, body->at("objects"), faults);
  if (!faults.empty()) return failure(std::move(faults));
  ReadScene scene{{}, {}, request.version, request.expires_in};
  std::vector<CollisionObject> objects;
  for (ObjectDescription& object : request.objects) {
    objects.push_back({std::move(object.name), object.shape, object.X_WO, object.mass});
  }
  scene.objects = std::make_shared<const std::vector<CollisionObject>>(std::move(objects));
  for (const auto& object : body->at("objects")) scene.texts.push_back(object.dump());
  return scene;
}

bool has_object(const std::vector<CollisionObject>& objects, std::string_view name) {
  return std::ranges::any_of(objects,
                             [&](const CollisionObject& object) { return object.name == name; });
}

Result<CollisionObject> read_object_text(std::string_view text,
                                         const std::optional<std::string>& name) {
  const auto body = parse_json(text, JsonComments::refused);
  if (!body) return failure(body.error());
  Problems faults;
  const JsonNode node(*body, "", faults);
  ObjectDescription object;
  (name ? named_object_request_format() : object_request_format())->read(node, object);
  if (name && object.name.empty() && !node.has("name")) {
    // A name in the path must obey the same rule as a name in the body.
    const nlohmann::json of_address(*name);
    object_name_format()->read(JsonNode(of_address, "/name", faults), object.name);
  } else if (name && node.is_object()) {
    node.optional("name", [&](const JsonNode& n) {
      if (n.raw().is_string() && n.raw() != *name) {
        n.invalid("name-differs", "the name differs from the name in the path, \"" + *name + "\"");
      }
    });
  }
  if (!faults.empty()) return failure(std::move(faults));
  return CollisionObject{std::move(object.name), object.shape, object.X_WO, object.mass};
}

FormatPtr<CollisionObject> object_format() {
  static const auto format = named<CollisionObject>(
      "Object",
      "An object of the scene, with exactly one shape. A mesh is given by its path on this server.",
      make_format<CollisionObjectFormat>());
  return format;
}

namespace {

template <class T>
const T* unless_empty(const T& list) {
  return list.empty() ? nullptr : &list;
}

FormatPtr<TouchView> touch_format() {
  return named("AllowedTouch",
               "Links that may touch an object of the scene at present, besides those that the "
               "cell file allows.",
               object<TouchView>({
                   output_only("object", &TouchView::object, text()),
                   output_only("links", &TouchView::links, list(text())),
               }));
}

}  // namespace

FormatPtr<HeldView> held_format() {
  using Other = HeldView::Other;
  const auto touch = [](const HeldView& view) { return unless_empty(view.touch); };
  const auto others = [](const HeldView& view) { return unless_empty(view.shared_with); };
  const auto other = named("OtherHand", "A further hand that holds an object.",
                           object<Other>({
                               output_only("link", &Other::link, text()),
                               output_only("arm", &Other::arm, text(), "Arm that moves the link"),
                           }));
  return named("HeldObject", "An object that an arm holds.",
               object<HeldView>({
                   output_only("object", &HeldView::object, object_format(),
                               "The object, with its pose in the frame of `link`"),
                   output_only("link", &HeldView::link, text(), "Link that carries the object"),
                   output_only("arm", &HeldView::arm, text(), "Arm that moves the link"),
                   output_if("touch", touch, list(text()),
                             "Links and objects that the object may touch at present, besides "
                             "the hand that holds it; absent if there are none"),
                   output_if("shared_with", others, list(other),
                             "Other hands that hold the object, too: their arms and `arm` move "
                             "only together; absent if there are none"),
               }));
}

FormatPtr<SceneView> scene_format() {
  const auto touch = [](const SceneView& view) { return unless_empty(view.touch); };
  const auto expired = [](const SceneView& view) { return unless_empty(view.expired); };
  static const auto format =
      named("Scene", "",
            object<SceneView>({
                output_only("version", &SceneView::version, count(),
                            "Version of the scene; grows with every change"),
                output_only(
                    "objects", [](const SceneView& view) { return &view.objects(); },
                    list(object_format())),
                output_only("held", &SceneView::held, list(held_format()),
                            "Objects that arms hold; they are not in `objects`"),
                output_if("touch", touch, list(touch_format()),
                          "Contact with objects that steps of jobs allow at present; absent if "
                          "there is none"),
                output_if("expires_s", &SceneView::expires_at, cell_time(),
                          "Cell time at which the objects of `expiring` are removed; absent if no "
                          "object expires"),
                output_if("expiring", &SceneView::expiring, list(text()),
                          "Names of the objects that expire; absent if there are none"),
                output_if("expired", expired, list(text()),
                          "Names of the objects that have expired with this version; absent if "
                          "there are none"),
            }));
  return format;
}

FormatPtr<SceneChange> scene_change_format() {
  static const auto format = named("SceneChange", "",
                                   object<SceneChange>({
                                       output_only("version", &SceneChange::version, count()),
                                       output_only("object", &SceneChange::object, object_format()),
                                   }));
  return format;
}

FormatPtr<std::uint64_t> scene_version_format() {
  static const auto format =
      named("SceneVersion", "",
            object<std::uint64_t>({output_only(
                "version", [](const std::uint64_t& version) { return version; }, count())}));
  return format;
}

}  // namespace armloom
