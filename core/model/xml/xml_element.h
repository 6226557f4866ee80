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

// Reads XML into `document`. DOCTYPE and entity declarations are refused, and so is nesting deeper
// than tinyxml2's bound (100), a second root element and unexpanded xacro. Returns the <robot>
// element, or null after adding what is wrong to `diagnostics` (place: "panda.urdf:12", the line).
[[nodiscard]] tinyxml2::XMLElement* parse_robot_xml(const std::string& text,
                                                    const std::string& file,
                                                    tinyxml2::XMLDocument& document,
                                                    Diagnostics& diagnostics);

[[nodiscard]] std::size_t count_children(const tinyxml2::XMLElement& element, const char* child);

// Reads one element of a robot file and reports what is wrong with it, under the place that it was
// made with: "panda.urdf:12: joint panda_joint3". Of an element below, and its attributes, the line
// is that element's own. The sentence is place + ": " + what is wrong.
class XmlPlace {
 public:
  // `line` 0: what is wrong stands in no line. `whose` may be empty.
  XmlPlace(std::string file, int line, std::string whose, Diagnostics& diagnostics)
      : file_(std::move(file)), line_(line), whose_(std::move(whose)), diagnostics_(&diagnostics) {}

  // The same at the line of another element; of a part of it ("joint j1"); told to another list.
  [[nodiscard]] XmlPlace at(const tinyxml2::XMLElement& element) const;
  [[nodiscard]] XmlPlace of(const std::string& part) const;
  [[nodiscard]] XmlPlace telling(Diagnostics& diagnostics) const;

  // The same place for what the cell does not use: all that is wrong there is only a warning, which
  // ends with this consequence.
  [[nodiscard]] XmlPlace only_warning(std::string consequence) const;

  [[nodiscard]] std::string text() const;
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
  // Reports a child that would count elsewhere only ("in a <link>"), and here be left out.
  void refuse_child(const tinyxml2::XMLElement& element, const char* child,
                    const char* where) const;
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
  void tell_unknown(const std::string& name, const std::string& before, const std::string& after,
                    Names used, Names unused) const;

  std::string file_;
  int line_;
  std::string whose_;
  Diagnostics* diagnostics_;
  std::optional<std::string> consequence_;  // given: of a place that only warns
};

}  // namespace armloom
