#include "core/geometry/mesh/sanitize_collada.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace armloom {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kSaturated = 1'000'000'000'000'000;
constexpr unsigned kMaxInputs = 64;

// Carries the reason out of nested calls; caught in this file.
struct Fault {
  std::string why;
};

std::size_t sum(std::size_t a, std::size_t b) { return std::min(kSaturated, a + b); }

template <class Visit>
void each_child(XMLElement& element, const Visit& visit) {
  for (auto* child = element.FirstChildElement(); child != nullptr;) {
    auto* next = child->NextSiblingElement();
    visit(*child);
    child = next;
  }
}

bool is_one_of(const XMLElement& element, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), element.Name()) != names.end();
}

void keep_children(XMLElement& element, std::initializer_list<std::string_view> names) {
  each_child(element, [&](XMLElement& child) {
    if (!is_one_of(child, names)) element.DeleteChild(&child);
  });
}

// Returns the value of a whole-number attribute, or `otherwise` if the attribute is missing.
unsigned count_of(const XMLElement& element, const char* attribute, unsigned otherwise) {
  unsigned value = otherwise;
  const auto read = element.QueryUnsignedAttribute(attribute, &value);
  if (read == tinyxml2::XML_SUCCESS || read == tinyxml2::XML_NO_ATTRIBUTE) return value;
  throw Fault{std::string("<") + element.Name() + "> " + attribute + " is '" +
              element.Attribute(attribute) + "', which is not a valid count"};
}

// Calls visit(number) for each word of the text. Throws if a word is not a Number.
template <class Number, class Visit>
void each_number(const XMLElement& element, const char* what, const Visit& visit) {
  std::string_view text = element.GetText() == nullptr ? "" : element.GetText();
  constexpr std::string_view kSpaces = " \t\r\n";
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
    if (text.empty()) return;
    const std::string_view word = text.substr(0, text.find_first_of(kSpaces));
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size()) {
      throw Fault{std::string("<") + element.Name() + "> holds '" +
                  std::string(word.substr(0, 40)) + "', which is not a valid " + what};
    }
    visit(number);
    text.remove_prefix(word.size());
  }
}

template <class Number>
std::size_t count_numbers(const XMLElement& element, const char* what) {
  std::size_t count = 0;
  each_number<Number>(element, what, [&](Number) { ++count; });
  return count;
}

// Checks that each array has as many numbers as it states, and that each accessor stays within its
// array. Returns the element count of the longest accessor.
std::size_t check_source(XMLElement& source) {
  std::size_t longest = 0;
  keep_children(source, {"float_array", "technique_common"});
  std::map<std::string, std::size_t, std::less<>> arrays;
  each_child(source, [&](XMLElement& array) {
    if (!is_one_of(array, {"float_array"})) return;
    const std::size_t numbers = count_numbers<double>(array, "number");
    if (count_of(array, "count", 0) != numbers) {
      throw Fault{"<float_array> states a count of " + std::to_string(count_of(array, "count", 0)) +
                  " but holds " + std::to_string(numbers) + " numbers"};
    }
    if (array.Attribute("id") != nullptr) arrays[array.Attribute("id")] = numbers;
  });
  each_child(source, [&](XMLElement& technique) {
    each_child(technique, [&](XMLElement& accessor) {
      if (!is_one_of(accessor, {"accessor"})) return;
      const char* name = accessor.Attribute("source");
      const auto array = arrays.find(name == nullptr || *name != '#' ? "" : name + 1);
      const std::size_t stride = count_of(accessor, "stride", 1);
      std::size_t parameters = 0;
      each_child(accessor, [&](XMLElement&) { ++parameters; });
      const std::size_t end =
          count_of(accessor, "offset", 0) + stride * count_of(accessor, "count", 0);
      if (array == arrays.end() || parameters > stride || end > array->second) {
        throw Fault{"an <accessor> asks for more than its array holds"};
      }
      longest = std::max(longest, std::size_t{count_of(accessor, "count", 0)});
    });
  });
  return longest;
}

// Returns the triangle count of <triangles>, and an upper bound for <polylist> and similar
// elements. Checks that all indices (one for each corner and input) are below `elements`.
std::size_t check_primitive(XMLElement& part, std::size_t elements) {
  keep_children(part, {"input", "p", "vcount"});
  unsigned inputs = 0;
  std::size_t announced = 0;
  std::size_t polygons = 0;
  each_child(part, [&](XMLElement& child) {
    if (is_one_of(child, {"input"})) inputs = std::max(inputs, count_of(child, "offset", 0) + 1);
    if (!is_one_of(child, {"vcount"})) return;
    each_number<std::uint32_t>(child, "count", [&](std::uint32_t corners) {
      announced = sum(announced, std::max(corners, std::uint32_t{1}));
      ++polygons;
    });
  });
  if (inputs == 0 || inputs > kMaxInputs) {
    throw Fault{std::string("<") + part.Name() + "> has no <input>, or an <input> offset above " +
                std::to_string(kMaxInputs - 1)};
  }
  std::size_t corners = 0;
  std::size_t lists = 0;
  each_child(part, [&](XMLElement& p) {
    if (!is_one_of(p, {"p"})) return;
    std::size_t indices = 0;
    each_number<std::uint32_t>(p, "index", [&](std::uint32_t index) {
      if (index >= elements) {
        throw Fault{"<p> holds index " + std::to_string(index) + ", the sources have " +
                    std::to_string(elements) + " elements"};
      }
      ++indices;
    });
    corners += indices / inputs;
    ++lists;
  });
  const bool by_count = is_one_of(part, {"polylist"});
  const bool triangles = is_one_of(part, {"triangles"});
  const std::size_t expected = by_count ? polygons : triangles ? corners / 3 : lists;
  if ((by_count && announced != corners) || count_of(part, "count", 0) != expected) {
    throw Fault{std::string("<") + part.Name() + ">: its count does not match its content"};
  }
  return triangles ? corners / 3 : corners;
}

class DaeReader {
 public:
  // Reduces and checks the document. Throws Fault.
  explicit DaeReader(XMLElement& root) {
    keep_children(
        root, {"asset", "library_geometries", "library_nodes", "library_visual_scenes", "scene"});
    each_child(root, [&](XMLElement& library) {
      if (is_one_of(library, {"library_geometries"})) {
        each_child(library, [&](XMLElement& geometry) { read_geometry(geometry); });
      } else if (is_one_of(library, {"library_nodes", "library_visual_scenes"})) {
        each_child(library, [&](XMLElement& node) { read_node(node); });
      }
    });
    for (const auto& [id, node] : scenes_) total_ = sum(total_, below(*node));
  }
  [[nodiscard]] std::size_t triangles() const { return total_; }

 private:
  void read_geometry(XMLElement& geometry) {
    keep_children(geometry, {"mesh"});
    std::size_t triangles = 0;
    each_child(geometry, [&](XMLElement& mesh) {
      keep_children(mesh, {"source", "vertices", "triangles", "polylist", "polygons", "tristrips",
                           "trifans"});
      std::size_t elements = 0;
      each_child(mesh, [&](XMLElement& part) {
        if (is_one_of(part, {"source"})) elements = std::max(elements, check_source(part));
      });
      each_child(mesh, [&](XMLElement& part) {
        if (is_one_of(part, {"source", "vertices"})) return;
        triangles = sum(triangles, check_primitive(part, elements));
      });
    });
    if (geometry.Attribute("id") != nullptr) geometries_[geometry.Attribute("id")] = triangles;
  }

  void read_node(XMLElement& node) {
    // Dropping these elements would change the shape, not only its appearance.
    each_child(node, [](const XMLElement& child) {
      if (is_one_of(child, {"skew", "instance_controller"})) {
        throw Fault{std::string("<") + child.Name() + "> is not supported"};
      }
    });
    keep_children(node, {"node", "matrix", "translate", "rotate", "scale", "lookat",
                         "instance_geometry", "instance_node"});
    const char* id = node.Attribute("id");
    if (is_one_of(node, {"visual_scene"}))
      scenes_.emplace_back(id == nullptr ? "" : id, &node);
    else if (id != nullptr)
      nodes_.try_emplace(id, &node);
    each_child(node, [&](XMLElement& child) {
      if (is_one_of(child, {"node"})) return read_node(child);
      if (is_one_of(child, {"instance_geometry", "instance_node"})) return child.DeleteChildren();
      static_cast<void>(count_numbers<double>(child, "number"));
    });
  }

  // Returns the triangle count of a node or scene, including the nodes that it instances. Each
  // instance adds a further one, so that multiplied empty nodes are limited too.
  std::size_t below(const XMLElement& node) {
    const auto known = placed_.find(&node);
    if (known != placed_.end()) return known->second;
    if (!open_.insert(&node).second) throw Fault{"its nodes instance each other in a cycle"};
    std::size_t total = 0;
    for (const auto* child = node.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      total = sum(total, of_child(*child));
    }
    open_.erase(&node);
    return placed_[&node] = total;
  }

  std::size_t of_child(const XMLElement& child) {
    if (is_one_of(child, {"node"})) return below(child);
    const char* url = child.Attribute("url");
    const std::string_view id = url == nullptr || *url != '#' ? "" : url + 1;
    if (is_one_of(child, {"instance_geometry"})) {
      const auto geometry = geometries_.find(id);
      return geometry == geometries_.end() ? 0 : geometry->second;
    }
    if (!is_one_of(child, {"instance_node"})) return 0;
    const auto node = nodes_.find(id);
    return node == nodes_.end() ? 1 : sum(below(*node->second), 1);
  }

  std::map<std::string, std::size_t, std::less<>> geometries_;
  std::map<std::string, const XMLElement*, std::less<>> nodes_;
  std::vector<std::pair<std::string, const XMLElement*>> scenes_;
  std::map<const XMLElement*, std::size_t> placed_;
  std::set<const XMLElement*> open_;
  std::size_t total_ = 0;
};

}  // namespace

tl::expected<DaeEssence, std::string> read_dae_essence(std::string_view bytes) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
    return tl::unexpected("it is not well-formed XML: line " +
                          std::to_string(document.ErrorLineNum()));
  }
  XMLElement* root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA") {
    return tl::unexpected<std::string>("its root element is not <COLLADA>");
  }
  try {
    const DaeReader reader(*root);
    tinyxml2::XMLPrinter printer(nullptr, true);
    root->Accept(&printer);
    return DaeEssence{std::string(printer.CStr()), reader.triangles()};
  } catch (const Fault& fault) {
    return tl::unexpected(fault.why);
  }
}

}  // namespace armloom
