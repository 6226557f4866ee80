#include "server/recording/recorded_scenes.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <utility>

#include "server/codec/json_node.h"
#include "server/codec/json_text.h"
#include "server/codec/scene_format.h"
#include "server/codec/value_formats.h"

namespace armloom {
namespace {

constexpr const char* kEvents = "events.jsonl";

// Reads one event. Members that the audit does not need are ignored.
class SceneReader {
 public:
  explicit SceneReader(const Cell& cell) : cell_(cell) {}

  // Returns nullopt if the event is of another type. `place` precedes pointers.
  [[nodiscard]] Result<std::optional<RecordedScene>> read(const std::string& line,
                                                          const std::string& place) const {
    auto event = parse_json(line, JsonComments::refused);
    if (!event) {
      for (Problem& problem : event.error()) problem.pointer.insert(0, place);
      return failure(std::move(event.error()));
    }
    if (!event->is_object() || !event->contains("type") || (*event)["type"] != "scene") {
      return std::nullopt;
    }
    Problems faults;
    RecordedScene scene;
    const JsonNode root(*event, place, faults);
    root.required("t_s",
                  [&](const JsonNode& time) { formats::cell_time()->read(time, scene.time); });
    root.required("data", [&](const JsonNode& data) { read(data, scene); });
    if (!faults.empty()) return failure(std::move(faults));
    return scene;
  }

 private:
  void read(const JsonNode& data, RecordedScene& scene) const {
    data.required("objects", [&](const JsonNode& objects) {
      objects.each([&](const JsonNode& object) { scene.objects.push_back(object_of(object)); });
    });
    data.optional("held", [&](const JsonNode& all) {
      all.each([&](const JsonNode& held) { read_held(held, scene); });
    });
    data.optional("touch", [&](const JsonNode& all) {
      all.each([&](const JsonNode& touch) {
        AllowedTouch& allowed = scene.touch.emplace_back();
        touch.required("object", [&](const JsonNode& name) { name.read(allowed.object); });
        touch.required("links", [&](const JsonNode& links) {
          links.each([&](const JsonNode& name) {
            if (const auto link = link_of(name)) allowed.links.push_back(*link);
          });
        });
      });
    });
  }

  void read_held(const JsonNode& node, RecordedScene& scene) const {
    std::optional<LinkId> link;
    node.required("link", [&](const JsonNode& name) {
      link = link_of(name);
      if (link && !cell_.link(*link).arm) {
        name.invalid("link-not-of-arm", "no arm moves link " + cell_.link(*link).name);
      }
    });
    if (!link) return;
    Attachment held{.object = {}, .link = *link, .X_LO = {}, .touch = {}};
    node.required("object", [&](const JsonNode& object) { held.object = object_of(object); });
    held.X_LO = held.object.X_WO;
    node.optional("touch", [&](const JsonNode& all) {
      std::vector<std::string> names;
      all.read(names);
      for (std::string& name : names) {
        if (const auto other = cell_.find_link(name)) {
          held.touch.push_back(*other);
        } else {
          held.touch_objects.push_back(std::move(name));
        }
      }
    });
    node.optional("shared_with", [&](const JsonNode& all) {
      all.each([&](const JsonNode& other) {
        other.required("link", [&](const JsonNode& name) {
          const auto hand = link_of(name);
          if (hand && cell_.link(*hand).arm) held.others.push_back({*hand});
        });
      });
    });
    scene.held.push_back(std::move(held));
  }

  [[nodiscard]] CollisionObject object_of(const JsonNode& node) const {
    ObjectDescription object;
    scene_object_format()->read(node, object);
    if (std::holds_alternative<Mesh>(object.shape)) {
      // The event has the mesh's address on the server, not its file.
      const auto same = std::ranges::find(cell_.objects, object.name, &CollisionObject::name);
      if (same != cell_.objects.end() && std::holds_alternative<Mesh>(same->shape)) {
        object.shape = same->shape;
      } else {
        node.invalid("unknown-mesh", "the cell has no object " + object.name + " with a mesh");
      }
    }
    return {std::move(object.name), std::move(object.shape), object.X_WO};
  }

  [[nodiscard]] std::optional<LinkId> link_of(const JsonNode& node) const {
    std::string name;
    if (!node.read(name)) return std::nullopt;
    const auto link = cell_.find_link(name);
    if (!link) node.invalid("unknown-link", "the cell has no link " + name);
    return link;
  }

  const Cell& cell_;
};

}  // namespace

Result<std::vector<RecordedScene>> read_scenes(const std::filesystem::path& folder,
                                               const Cell& cell,
                                               std::vector<std::string>* warnings) {
  std::vector<RecordedScene> scenes;
  std::error_code ec;
  if (!std::filesystem::exists(folder / kEvents, ec)) return scenes;
  std::ifstream in(folder / kEvents, std::ios::binary);
  if (!in) {
    return failure(Problem{ProblemKind::invalid, "bad-recording", kEvents, "cannot be opened", {}});
  }
  const SceneReader reader(cell);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const std::string place = kEvents + (":" + std::to_string(number));
    if (in.eof()) {
      if (warnings != nullptr) {
        warnings->push_back(place +
                            ": the last line has no line end: the recording was cut off "
                            "there, the line is ignored");
      }
      break;
    }
    if (line.find("\"scene\"") == line.npos) continue;
    auto scene = reader.read(line, place);
    if (!scene) return failure(std::move(scene.error()));
    if (!*scene) continue;
    if (!scenes.empty() && (*scene)->time < scenes.back().time) {
      return failure(Problem{ProblemKind::invalid, "bad-recording", place + "/t_s",
                             "times of events must not decrease", to_seconds((*scene)->time)});
    }
    scenes.push_back(*std::move(*scene));
  }
  return scenes;
}

}  // namespace armloom
