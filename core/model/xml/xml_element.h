#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace armloom {

enum class Presence { required, optional };

// Parses XML into `document`. Refuses DOCTYPE and entity declarations, deep nesting (100), a second
// root element and unexpanded xacro. Returns the <robot> element, or nullptr with the fault and its
// line in `diagnostics`.
[[nodiscard]] tinyxml2::XMLElement* parse_robot_xml(const std::string& text,
                                                    const std::string& file,
                                                    tinyxml2::XMLDocument& document,
                                                    Diagnostics& diagnostics);

[[nodiscard]] std::size_t count_children(const tinyxml2::XMLElement& element, const char* child);

// The place of an XML element in a robot file, such as "panda.urdf:12: joint panda_joint3". Reads
// the element and reports faults with this place. Faults of a child element are reported with the
// child's line.
class XmlPlace {
 public:
  // If `line` is 0, the place has no line number. `whose` ("joint panda_joint3") may be empty.
  XmlPlace(std::string file, int line, std::string whose, Diagnostics& diagnostics)
      : file_(std::move(file)), line_(line), whose_(std::move(whose)), diagnostics_(&diagnostics) {}

  // Return a copy of this place. at() uses the line of another element, of() adds a part ("joint
  // j1"), and telling() reports to other diagnostics.
  [[nodiscard]] XmlPlace at(const tinyxml2::XMLElement& element) const;
  [[nodiscard]] XmlPlace of(const std::string& part) const;
  [[nodiscard]] XmlPlace telling(Diagnostics& diagnostics) const;

  // Returns a copy of this place for parts that the cell does not use. Their faults become warnings
  // that state the consequence.
  [[nodiscard]] XmlPlace only_warning(std::string consequence) const;

  [[nodiscard]] std::string text() const;
  void report(std::string slug, const std::string& sentence, decltype(Problem::value) value = {},
              ProblemKind kind = ProblemKind::invalid) const;
  void warn(std::string slug, const std::string& sentence,
            decltype(Problem::value) value = {}) const;

  // Returns one finite number. If it is faulty, or required but missing, reports this and returns
  // nullopt. If it is optional and missing, returns nullopt.
  std::optional<double> number(const tinyxml2::XMLElement& element, const char* attribute,
                               Presence presence) const;
  // Returns exactly `size` finite numbers. Faulty and missing numbers are treated as by number().
  std::optional<std::vector<double>> numbers(const tinyxml2::XMLElement& element,
                                             const char* attribute, std::size_t size,
                                             Presence presence) const;
  // Returns a non-empty attribute, or "" with a report.
  std::string name(const tinyxml2::XMLElement& element, const char* attribute) const;
  // Returns the first child of that name, or nullptr. Reports a second child, which libraries would
  // ignore, and a missing child that is required.
  const tinyxml2::XMLElement* only_child(const tinyxml2::XMLElement& element, const char* child,
                                         Presence presence) const;
  // Reports a child that is ignored here. `where` is its proper place ("in a <link>").
  void refuse_child(const tinyxml2::XMLElement& element, const char* child,
                    const char* where) const;
  // Names of elements or attributes.
  using Names = std::initializer_list<std::string_view>;

  // Checks the names of the children. A probable misspelling of a name in `used` is a problem,
  // because <colision> would leave its link without a shape. Names in `unused` are accepted, and so
  // are other namespaces (drake:..., mujoco:...). Other names are warnings.
  void only_children(const tinyxml2::XMLElement& element, Names used, Names unused) const;
  // Checks the names of attributes in the same way, because libraries would ignore <origin
  // xzy="...">.
  void only_attributes(const tinyxml2::XMLElement& element, Names used) const;

 private:
  void tell_unknown(const std::string& name, const std::string& before, const std::string& after,
                    Names used, Names unused) const;

  std::string file_;
  int line_;
  std::string whose_;
  Diagnostics* diagnostics_;
  std::optional<std::string> consequence_;  // set if faults are only warnings
};

}  // namespace armloom
