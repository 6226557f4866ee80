#include "core/model/mesh_bounds.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <set>

namespace armloom {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kSaturated = 1'000'000'000'000'000;

std::size_t sum(std::size_t a, std::size_t b) { return std::min(kSaturated, a + b); }

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::size_t words_in(std::string_view text) {
  std::size_t words = 0;
  bool in_word = false;
  for (const char c : text) {
    const bool letter = !is_space(c);
    words += letter && !in_word ? 1U : 0U;
    in_word = letter;
  }
  return words;
}

// Binary: 80 bytes, the number of triangles, 50 bytes for each. Text: three times "vertex" for each.
std::size_t stl_triangles(std::string_view bytes) {
  constexpr std::size_t kHeader = 84;
  if (bytes.size() >= kHeader) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    if (bytes.size() == kHeader + std::size_t{50} * count || !bytes.starts_with("solid")) return count;
  }
  std::size_t corners = 0;
  for (auto at = bytes.find("vertex"); at != bytes.npos; at = bytes.find("vertex", at + 6)) ++corners;
  return corners / 3;
}

// A face of n corners is n - 2 triangles.
std::size_t obj_triangles(std::string_view bytes) {
  std::size_t triangles = 0;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
    if (line.size() < 2 || line.front() != 'f' || !is_space(line[1])) continue;
    const std::size_t corners = words_in(line.substr(1));
    if (corners > 2) triangles += corners - 2;
  }
  return triangles;
}

// Follows the nodes of a COLLADA document. Geometries are counted by the indices that they hold.
class DaeCount {
 public:
  explicit DaeCount(const XMLElement& root) { visit(root); }

  // Nothing when nodes place themselves.
  [[nodiscard]] std::optional<std::size_t> triangles() {
    std::size_t total = 0;
    for (const XMLElement* scene : scenes_) {
      const auto placed = below(*scene);
      if (!placed) return std::nullopt;
      total = sum(total, *placed);
    }
    return total;
  }

 private:
  void visit(const XMLElement& element) {
    const std::string_view name = element.Name();
    const char* id = element.Attribute("id");
    if (name == "geometry") {
      const std::size_t triangles = of_geometry(element);
      if (id != nullptr) geometries_[id] = triangles;
      all_geometries_ = sum(all_geometries_, triangles);
      return;
    }
    if (name == "node" && id != nullptr) nodes_.try_emplace(id, &element);
    if (name == "visual_scene") scenes_.push_back(&element);
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      visit(*child);
    }
  }

  static std::size_t of_geometry(const XMLElement& geometry) {
    std::size_t triangles = 0;
    for (const auto* mesh = geometry.FirstChildElement("mesh"); mesh != nullptr;
         mesh = mesh->NextSiblingElement("mesh")) {
      for (const auto* part = mesh->FirstChildElement(); part != nullptr; part = part->NextSiblingElement()) {
        triangles = sum(triangles, of_primitive(*part));
      }
    }
    return triangles;
  }

  // <triangles>, <polylist> and the like: as many corners as indices, divided by those of a corner.
  static std::size_t of_primitive(const XMLElement& part) {
    std::size_t stride = 0;
    for (const auto* input = part.FirstChildElement("input"); input != nullptr;
         input = input->NextSiblingElement("input")) {
      stride = std::max(stride, static_cast<std::size_t>(input->UnsignedAttribute("offset")) + 1);
    }
    if (stride == 0 || stride > 64) stride = 1;
    const bool separate = std::string_view(part.Name()) == "triangles";
    std::size_t triangles = 0;
    for (const auto* p = part.FirstChildElement("p"); p != nullptr; p = p->NextSiblingElement("p")) {
      const std::size_t corners = words_in(p->GetText() == nullptr ? "" : p->GetText()) / stride;
      triangles = sum(triangles, separate ? corners / 3 : corners);
    }
    return triangles;
  }

  // The triangles that a node or scene places, its own and those of nodes that it names.
  std::optional<std::size_t> below(const XMLElement& node) {
    const auto known = placed_.find(&node);
    if (known != placed_.end()) return known->second;
    if (!open_.insert(&node).second) return std::nullopt;
    std::size_t total = 0;
    for (const auto* child = node.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const auto placed = of_child(*child);
      if (!placed) return std::nullopt;
      total = sum(total, *placed);
    }
    open_.erase(&node);
    return placed_[&node] = total;
  }

  std::optional<std::size_t> of_child(const XMLElement& child) {
    const std::string_view name = child.Name();
    if (name == "node") return below(child);
    if (name == "instance_controller") return all_geometries_;
    const char* url = child.Attribute("url");
    if (url == nullptr || *url != '#') return std::size_t{0};
    if (name == "instance_geometry") {
      const auto geometry = geometries_.find(url + 1);
      return geometry == geometries_.end() ? std::size_t{0} : geometry->second;
    }
    if (name != "instance_node") return std::size_t{0};
    const auto node = nodes_.find(url + 1);
    // Nodes without geometry multiply too: each counts as one.
    if (node == nodes_.end()) return std::size_t{1};
    const auto placed = below(*node->second);
    if (!placed) return std::nullopt;
    return sum(*placed, 1);
  }

  std::map<std::string, std::size_t, std::less<>> geometries_;
  std::map<std::string, const XMLElement*, std::less<>> nodes_;
  std::vector<const XMLElement*> scenes_;
  std::map<const XMLElement*, std::size_t> placed_;
  std::set<const XMLElement*> open_;
  std::size_t all_geometries_ = 0;
};

tl::expected<std::size_t, std::string> dae_triangles(std::string_view bytes) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
    return tl::unexpected("it is no XML: line " + std::to_string(document.ErrorLineNum()));
  }
  const XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA") {
    return tl::unexpected<std::string>("its root element is not <COLLADA>");
  }
  const auto triangles = DaeCount(*root).triangles();
  if (!triangles) return tl::unexpected<std::string>("its nodes place themselves");
  return *triangles;
}

}  // namespace

tl::expected<std::size_t, std::string> most_triangles(MeshFormat format, std::string_view bytes) {
  switch (format) {
    case MeshFormat::stl:
      return stl_triangles(bytes);
    case MeshFormat::obj:
      return obj_triangles(bytes);
    case MeshFormat::dae:
      break;
  }
  return dae_triangles(bytes);
}

}  // namespace armloom
