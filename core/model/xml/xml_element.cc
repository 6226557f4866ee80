#include "core/model/xml/xml_element.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>

#include "core/base/nearest_name.h"
#include "core/model/xml/xml_numbers.h"

namespace armloom {
namespace {

// Returns the first declaration such as DOCTYPE or ENTITY, or nullptr.
const tinyxml2::XMLUnknown* find_declaration(const tinyxml2::XMLNode& node) {
  for (const auto* child = node.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (const auto* unknown = child->ToUnknown()) return unknown;
    if (const auto* below = find_declaration(*child)) return below;
  }
  return nullptr;
}

// Returns the first element of the xacro namespace at any depth, or nullptr.
const tinyxml2::XMLElement* find_xacro(const tinyxml2::XMLElement& element) {
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (std::string_view(child->Name()).starts_with("xacro:")) return child;
    if (const auto* below = find_xacro(*child)) return below;
  }
  return nullptr;
}

std::string why_malformed(const tinyxml2::XMLDocument& document, const std::string& text) {
  if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
    return "elements are nested too deeply";
  if (text.find("<!DOCTYPE") != std::string::npos)
    return "a DOCTYPE is not allowed; delete it, robots need none";
  const auto what = [&]() -> std::string {
    switch (document.ErrorID()) {
      case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
        return "the element that begins here has no matching closing tag";
      case tinyxml2::XML_ERROR_PARSING_ELEMENT:
        return "this is not a readable tag";
      case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
        return "an attribute is not name=\"value\"";
      case tinyxml2::XML_ERROR_PARSING_TEXT:
        return "there is text outside of the elements, or an element is not closed";
      case tinyxml2::XML_ERROR_PARSING_COMMENT:
        return "a comment is not closed by -->";
      case tinyxml2::XML_ERROR_PARSING:
        return "the element that begins here is not closed; was the file cut off?";
      case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
        return "the file holds no element";
      default:
        return document.ErrorName();
    }
  }();
  return "the XML is malformed: " + what;
}

}  // namespace

tinyxml2::XMLElement* parse_robot_xml(const std::string& text, const std::string& file,
                                      tinyxml2::XMLDocument& document, Diagnostics& diagnostics) {
  const auto refuse = [&](int line, const std::string& sentence) {
    XmlPlace(file, line, "", diagnostics)
        .report("xml-malformed", sentence, {}, ProblemKind::malformed);
    return nullptr;
  };
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return refuse(document.ErrorLineNum(), why_malformed(document, text));
  }
  if (const auto* declaration = find_declaration(document)) {
    return refuse(declaration->GetLineNum(),
                  "a DOCTYPE or entity declaration is not allowed; delete it, robots need none");
  }
  auto* root = document.RootElement();
  if (root == nullptr) return refuse(1, "the file holds no XML element");
  if (const auto* second = root->NextSiblingElement()) {
    return refuse(second->GetLineNum(), "the file holds more than one XML element");
  }
  if (std::string_view(root->Name()) != "robot") {
    return refuse(root->GetLineNum(),
                  std::string("the root element is <") + root->Name() + ">, not <robot>");
  }
  if (const auto* xacro = find_xacro(*root)) {
    return refuse(xacro->GetLineNum(),
                  "the file is xacro: give it a name that ends in .xacro, or expand it "
                  "(xacro IN > OUT) and use the result");
  }
  return root;
}

std::size_t count_children(const tinyxml2::XMLElement& element, const char* child) {
  std::size_t count = 0;
  for (const auto* one = element.FirstChildElement(child); one != nullptr;
       one = one->NextSiblingElement(child)) {
    ++count;
  }
  return count;
}

XmlPlace XmlPlace::at(const tinyxml2::XMLElement& element) const {
  XmlPlace other = *this;
  other.line_ = element.GetLineNum();
  return other;
}

XmlPlace XmlPlace::of(const std::string& part) const {
  XmlPlace other = *this;
  other.whose_ += ": " + part;
  return other;
}

XmlPlace XmlPlace::telling(Diagnostics& diagnostics) const {
  XmlPlace other = *this;
  other.diagnostics_ = &diagnostics;
  return other;
}

std::string XmlPlace::text() const {
  return file_ + (line_ > 0 ? ":" + std::to_string(line_) : "") +
         (whose_.empty() ? "" : ": " + whose_);
}

XmlPlace XmlPlace::only_warning(std::string consequence) const {
  XmlPlace other = *this;
  other.consequence_ = std::move(consequence);
  return other;
}

void XmlPlace::report(std::string slug, const std::string& sentence, decltype(Problem::value) value,
                      ProblemKind kind) const {
  if (consequence_) return warn(std::move(slug), sentence + "; " + *consequence_, std::move(value));
  const std::string place = text();
  diagnostics_->add({kind, std::move(slug), place, place + ": " + sentence, std::move(value)});
}

void XmlPlace::warn(std::string slug, const std::string& sentence,
                    decltype(Problem::value) value) const {
  const std::string place = text();
  diagnostics_->warn(
      {ProblemKind::invalid, std::move(slug), place, place + ": " + sentence, std::move(value)});
}

std::optional<double> XmlPlace::number(const tinyxml2::XMLElement& element, const char* attribute,
                                       Presence presence) const {
  const auto one = numbers(element, attribute, 1, presence);
  return one ? std::optional(one->front()) : std::nullopt;
}

std::optional<std::vector<double>> XmlPlace::numbers(const tinyxml2::XMLElement& element,
                                                     const char* attribute, std::size_t size,
                                                     Presence presence) const {
  const std::string what = std::string(element.Name()) + " " + attribute;
  const char* text = element.Attribute(attribute);
  if (text == nullptr) {
    if (presence == Presence::required) at(element).report("missing", what + " is missing");
    return std::nullopt;
  }
  auto read = parse_numbers(text);
  if (!read || read->size() != size) {
    const std::string wanted =
        size == 1 ? "a finite number" : std::to_string(size) + " finite numbers";
    at(element).report("not-a-number", what + " is '" + text + "', not " + wanted,
                       std::string(text));
    return std::nullopt;
  }
  return read;
}

std::string XmlPlace::name(const tinyxml2::XMLElement& element, const char* attribute) const {
  const char* text = element.Attribute(attribute);
  if (text == nullptr || *text == '\0') {
    at(element).report("missing", std::string(element.Name()) + " " + attribute + " is missing");
    return {};
  }
  return text;
}

const tinyxml2::XMLElement* XmlPlace::only_child(const tinyxml2::XMLElement& element,
                                                 const char* child, Presence presence) const {
  const auto* first = element.FirstChildElement(child);
  if (first == nullptr) {
    if (presence == Presence::required)
      at(element).report("missing", std::string("<") + child + "> is missing");
  } else if (const auto* second = first->NextSiblingElement(child)) {
    at(*second).report("duplicate",
                       std::string("more than one <") + child + ">; only the first is used");
  }
  return first;
}

void XmlPlace::refuse_child(const tinyxml2::XMLElement& element, const char* child,
                            const char* where) const {
  const auto* misplaced = element.FirstChildElement(child);
  if (misplaced == nullptr) return;
  const std::string tag = std::string("<") + child + ">";
  at(*misplaced).report("misplaced", tag + " would be left out here: it must be " + where, tag);
}

void XmlPlace::tell_unknown(const std::string& name, const std::string& before,
                            const std::string& after, Names used, Names unused) const {
  const auto is_in = [](Names names, std::string_view one) {
    return std::find(names.begin(), names.end(), one) != names.end();
  };
  if (is_in(used, name) || is_in(unused, name) || name.find(':') != std::string::npos) return;
  std::vector<std::string_view> known(used);
  known.insert(known.end(), unused.begin(), unused.end());
  std::string lower_case = name;
  for (char& c : lower_case) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto meant = nearest_name(lower_case, known);
  const std::string what = before + name + after;
  const std::string hint =
      meant ? "; did you mean " + before + std::string(*meant) + after + "?" : "";
  if (meant && is_in(used, *meant)) return report("misspelt", what + " is not known" + hint, name);
  warn("unknown-element", what + " is not known here and is left out" + hint, name);
}

void XmlPlace::only_children(const tinyxml2::XMLElement& element, Names used, Names unused) const {
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    at(*child).tell_unknown(child->Name(), "<", ">", used, unused);
  }
}

void XmlPlace::only_attributes(const tinyxml2::XMLElement& element, Names used) const {
  for (const auto* one = element.FirstAttribute(); one != nullptr; one = one->Next()) {
    at(element).tell_unknown(one->Name(), std::string(element.Name()) + " attribute ", "", used,
                             {});
  }
}

}  // namespace armloom
