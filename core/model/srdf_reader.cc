#include "core/model/srdf_reader.h"

#include <tinyxml2.h>

#include <algorithm>

#include "core/model/srdf_groups.h"
#include "core/model/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

class SrdfReader {
 public:
  SrdfReader(const XMLElement& srdf, std::string file, const RobotTree& tree, Findings& findings)
      : srdf_(srdf), file_(std::move(file)), tree_(tree), findings_(findings) {}

  RobotSemantics read() {
    RobotSemantics semantics;
    const std::set<std::string> virtual_joints = read_virtual_joints();
    const std::size_t before = findings_.count();
    semantics.groups = read_groups(srdf_, file_, tree_, virtual_joints, findings_);
    if (findings_.count() == before) {  // states of broken groups would only repeat what is wrong
      for_each("group_state",
               [&](const XMLElement& state) { read_state(state, virtual_joints, semantics); });
    }
    for_each("passive_joint",
             [&](const XMLElement& passive) { read_passive_joint(passive, virtual_joints); });
    read_allowed_pairs(semantics);
    return semantics;
  }

 private:
  template <class Visit>
  void for_each(const char* tag, Visit visit) const {
    for (const auto* child = srdf_.FirstChildElement(tag); child != nullptr;
         child = child->NextSiblingElement(tag)) {
      visit(*child);
    }
  }

  XmlPlace at_line(const XMLElement& element) const {
    return {file_ + ": " + element.Name() + " at line " + std::to_string(element.GetLineNum()),
            findings_};
  }

  std::set<std::string> read_virtual_joints() const {
    std::set<std::string> names;
    for_each("virtual_joint",
             [&](const XMLElement& joint) { names.insert(at_line(joint).name(joint, "name")); });
    return names;
  }

  // The value of a passive joint is not ours to command; only its name can be wrong.
  void read_passive_joint(const XMLElement& passive,
                          const std::set<std::string>& virtual_joints) const {
    const XmlPlace place = at_line(passive);
    const std::string name = place.name(passive, "name");
    if (name.empty() || virtual_joints.contains(name) || tree_.by_joint.contains(name)) return;
    place.report("unknown-name", "joint " + name + " is not in " + tree_.file, name);
  }

  void read_state(const XMLElement& element, const std::set<std::string>& virtual_joints,
                  RobotSemantics& semantics) const {
    const XmlPlace line = at_line(element);
    const std::string name = line.name(element, "name");
    const std::string group = line.name(element, "group");
    if (name.empty() || group.empty()) return;
    const XmlPlace place(file_ + ": group_state " + name + " of " + group, findings_);
    const auto found = semantics.groups.find(group);
    if (found == semantics.groups.end()) {
      return place.report("unknown-name", "group " + group + " does not exist", group);
    }
    RobotSemantics::State state;
    for (const auto* joint = element.FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      read_state_value(*joint, found->second, virtual_joints, place, state);
    }
    if (!semantics.states[group].emplace(name, std::move(state)).second) {
      place.report("duplicate-name", "more than one state of this group has this name", name);
    }
  }

  void read_state_value(const XMLElement& element, const RobotSemantics::JointSet& group,
                        const std::set<std::string>& virtual_joints, const XmlPlace& place,
                        RobotSemantics::State& state) const {
    const std::string name = place.name(element, "name");
    if (name.empty() || virtual_joints.contains(name)) return;
    const auto found = tree_.by_joint.find(name);
    if (found == tree_.by_joint.end()) {
      return place.report("unknown-name", "joint " + name + " is not in " + tree_.file, name);
    }
    const auto value = XmlPlace(place.text() + ": joint " + name, findings_)
                           .number(element, "value", Presence::required);
    const TreeLink& link = tree_.links[found->second];
    if (!value || !link.is_independent())
      return;  // fixed and mimic joints have no value of their own
    if (!group.contains(found->second)) {
      return place.report("foreign-joint", "joint " + name + " is not in the group", name);
    }
    if (*value < link.lower || *value > link.upper) {
      place.report("limit-exceeded",
                   "joint " + name + " is at " + text_of(*value) + ", outside [" +
                       text_of(link.lower) + ", " + text_of(link.upper) + "]",
                   *value);
    }
    if (!state.emplace(found->second, *value).second) {
      place.report("duplicate-name", "joint " + name + " has more than one value", name);
    }
  }

  std::optional<std::size_t> link_at(const XMLElement& element, const char* attribute) const {
    const XmlPlace place = at_line(element);
    const std::string name = place.name(element, attribute);
    if (name.empty()) return std::nullopt;
    const auto found = tree_.by_link.find(name);
    if (found != tree_.by_link.end()) return found->second;
    place.report("unknown-name", "link " + name + " is not in " + tree_.file, name);
    return std::nullopt;
  }

  template <class Visit>
  void for_each_pair(const char* tag, Visit visit) const {
    for_each(tag, [&](const XMLElement& element) {
      const auto a = link_at(element, "link1");
      const auto b = link_at(element, "link2");
      if (!a || !b) return;
      if (a == b)
        return at_line(element).report("same-link", "link1 and link2 are the same link",
                                       tree_.links[*a].name);
      visit(std::minmax(*a, *b));
    });
  }

  void read_allowed_pairs(RobotSemantics& semantics) const {
    for_each("disable_default_collisions", [&](const XMLElement& element) {
      const auto link = link_at(element, "link");
      for (std::size_t other = 0; link && other < tree_.links.size(); ++other) {
        if (other != *link) semantics.allowed_pairs.insert(std::minmax(*link, other));
      }
    });
    for_each_pair("enable_collisions",
                  [&](const auto& pair) { semantics.allowed_pairs.erase(pair); });
    for_each_pair("disable_collisions",
                  [&](const auto& pair) { semantics.allowed_pairs.insert(pair); });
  }

  const XMLElement& srdf_;
  std::string file_;
  const RobotTree& tree_;
  Findings& findings_;
};

}  // namespace

std::optional<RobotSemantics> read_srdf(std::string text, const std::filesystem::path& path,
                                        const RobotTree& tree, Findings& findings) {
  const std::size_t before = findings.count();
  const std::string file = path.filename().string();
  tinyxml2::XMLDocument document;
  const auto* srdf = parse_robot_xml(text, file, document, findings);
  if (srdf == nullptr) return std::nullopt;
  RobotSemantics semantics = SrdfReader(*srdf, file, tree, findings).read();
  if (findings.count() != before) return std::nullopt;
  semantics.file = file;
  semantics.text = std::move(text);
  return semantics;
}

}  // namespace armloom
