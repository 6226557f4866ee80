#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/findings.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace armloom {

enum class Presence { required, optional };

// Reads XML into `document`. DOCTYPE and entity declarations are refused, and so is nesting deeper
// than tinyxml2's bound (100), a second root element and unexpanded xacro. Returns the <robot>
// element, or null after adding what is wrong to `findings` (place: "panda.urdf:12", the line).
[[nodiscard]] tinyxml2::XMLElement* parse_robot_xml(const std::string& text,
                                                    const std::string& file,
                                                    tinyxml2::XMLDocument& document,
                                                    Findings& findings);

[[nodiscard]] std::size_t count_children(const tinyxml2::XMLElement& element, const char* child);

// Reads one element of a robot file and reports what is wrong with it, always under the place that
// it was made with: "panda.urdf: joint panda_joint3". The sentence is place + ": " + what is wrong.
class XmlPlace {
 public:
  XmlPlace(std::string place, Findings& findings)
      : place_(std::move(place)), findings_(&findings) {}

  // The same place for what the cell does not use: all that is wrong there is only a warning, which
  // ends with this consequence.
  [[nodiscard]] XmlPlace only_warning(std::string consequence) const;

  [[nodiscard]] const std::string& text() const { return place_; }
  void report(std::string slug, const std::string& sentence, decltype(Problem::value) value = {},
              ProblemKind kind = ProblemKind::invalid) const;
  void warn(std::string slug, const std::string& sentence,
            decltype(Problem::value) value = {}) const;

  // One finite number; nothing (and reported, unless absent and optional) otherwise.
  std::optional<double> number(const tinyxml2::XMLElement& element, const char* attribute,
                               Presence presence) const;
  // Exactly `size` finite numbers.
  std::optional<std::vector<double>> numbers(const tinyxml2::XMLElement& element,
                                             const char* attribute, std::size_t size,
                                             Presence presence) const;
  // A non-empty attribute; empty (and reported) otherwise.
  std::string name(const tinyxml2::XMLElement& element, const char* attribute) const;
  // The only child of that name. Libraries take the first of several and forget the others: a
  // second one is reported.
  const tinyxml2::XMLElement* only_child(const tinyxml2::XMLElement& element, const char* child,
                                         Presence presence) const;
  // Names of elements or attributes.
  using Names = std::initializer_list<std::string_view>;

  // Tells of children of other names. One that most likely is a misspelt name of `used`, which the
  // model is made of, is reported: <colision> would leave its link without a shape. Others may
  // stand there without a word (`unused`), or are warned of; those of another namespace
  // (drake:..., mujoco:...) are extensions.
  void only_children(const tinyxml2::XMLElement& element, Names used, Names unused) const;
  // The same of attributes: <origin xzy="..."> would be no shift.
  void only_attributes(const tinyxml2::XMLElement& element, Names used) const;

 private:
  void tell_unknown(const std::string& name, int line, const std::string& before,
                    const std::string& after, Names used, Names unused) const;

  std::string place_;
  Findings* findings_;
  std::optional<std::string> consequence_;  // given: of a place that only warns
};

}  // namespace armloom
