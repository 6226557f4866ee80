#include "core/model/srdf/srdf_reader.h"

#include <tinyxml2.h>

#include <algorithm>

#include "core/model/srdf/srdf_groups.h"
#include "core/model/srdf/srdf_names.h"
#include "core/model/urdf/lacking_prefix.h"
#include "core/model/xml/robot_file.h"
#include "core/model/xml/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

// Counts the elements of one tag that name links unknown to the URDF. They are reported together,
// because an outdated SRDF has many.
struct StaleElements {
  std::size_t stale = 0;
  std::size_t all = 0;
  std::string examples;
};

class SrdfReader {
 public:
  SrdfReader(const XMLElement& srdf, std::string file, const RobotTree& tree,
             Diagnostics& diagnostics)
      : srdf_(srdf), file_(std::move(file)), tree_(tree), diagnostics_(diagnostics) {}

  RobotSemantics read(const std::set<std::string>& used_groups) {
    RobotSemantics semantics;
    check_name();
    XmlPlace(file_, srdf_.GetLineNum(), "robot", diagnostics_)
        .only_children(
            srdf_,
            {"group", "disable_collisions", "disable_default_collisions", "enable_collisions"},
            {"group_state", "end_effector", "virtual_joint", "passive_joint", "joint_property",
             "link_sphere_approximation"});
    const std::set<std::string> virtual_joints = read_virtual_joints();
    semantics.groups =
        read_groups(srdf_, file_, tree_, {virtual_joints, used_groups}, diagnostics_);
    for_each("group_state",
             [&](const XMLElement& state) { read_state(state, virtual_joints, semantics); });
    for_each("passive_joint", [&](const XMLElement& passive) {
      read_passive_joint(passive, virtual_joints, semantics);
    });
    read_allowed_pairs(semantics);
    warn_of_stale_elements();
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
    return {file_, element.GetLineNum(), element.Name(), diagnostics_};
  }

  void check_name() const {
    const XmlPlace place(file_, srdf_.GetLineNum(), "robot", diagnostics_);
    const std::string name =
        place.only_warning("it may belong to another robot than the URDF").name(srdf_, "name");
    if (name.empty() || name == tree_.name || tree_.links.empty()) return;
    place.warn(
        "other-robot",
        "the SRDF is for robot " + name + ", but " + tree_.file + " for robot " + tree_.name +
            "; its groups and disabled pairs of links are used all the same, so a wrong SRDF "
            "can hide collisions: use the SRDF of this robot",
        name);
  }

  bool is_root(const std::string& link) const {
    const auto found = tree_.by_link.find(link);
    return found != tree_.by_link.end() && !tree_.links[found->second].parent;
  }

  std::set<std::string> read_virtual_joints() const {
    std::set<std::string> names;
    for_each("virtual_joint", [&](const XMLElement& joint) {
      const XmlPlace place = at_line(joint);
      names.insert(place.only_warning("it is left out").name(joint, "name"));
      const char* child = joint.Attribute("child_link");
      if (child != nullptr && !tree_.patched && !is_root(child)) {
        place.warn("other-child",
                   "child_link " + std::string(child) + " is not the root link " +
                       tree_.links.front().name + " of " + tree_.file +
                       "; it is left out: the cell's \"base\" places the root link",
                   std::string(child));
      }
      const char* type = joint.Attribute("type");
      if (type == nullptr || std::string_view(type) == "fixed") return;
      place.warn("moving-base",
                 std::string("it makes the robot's base ") + type +
                     ", but here the base stays where the cell's \"base\" places it: what the arms "
                     "meet elsewhere is not checked",
                 std::string(type));
    });
    return names;
  }

  void read_passive_joint(const XMLElement& passive, const std::set<std::string>& virtual_joints,
                          RobotSemantics& semantics) const {
    const XmlPlace place = at_line(passive).only_warning("it is left out");
    const std::string name = place.name(passive, "name");
    if (name.empty() || virtual_joints.contains(name)) return;
    const auto found = tree_.by_joint.find(name);
    if (found != tree_.by_joint.end())
      semantics.passive.emplace(found->second, place.text());
    else if (!tree_.nameless)
      place.report("unknown-name", "joint " + name + " is not in " + tree_.file, name);
  }

  // Reads a group_state. A state with faults can be neither a home nor a goal.
  void read_state(const XMLElement& element, const std::set<std::string>& virtual_joints,
                  RobotSemantics& semantics) const {
    const std::string consequence = "the state is left out";
    const XmlPlace line = at_line(element).only_warning(consequence);
    const std::string name = line.name(element, "name");
    const std::string group = line.name(element, "group");
    if (name.empty() || group.empty()) return;
    NamedState state;
    const XmlPlace place(file_, element.GetLineNum(), "group_state " + name + " of " + group,
                         state.faults);
    state.place = place.text();
    const auto found = semantics.groups.find(group);
    if (found == semantics.groups.end()) {
      return place.telling(diagnostics_)
          .only_warning(consequence)
          .report("unknown-name", "group " + group + " does not exist", group);
    }
    for (const auto* joint = element.FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      read_state_value(*joint, found->second, virtual_joints, place, state);
    }
    const auto [known, first] = semantics.states[group].emplace(name, std::move(state));
    if (first) return;
    place.telling(known->second.faults)
        .report("duplicate-name", "more than one state of this group has this name", name);
  }

  void read_state_value(const XMLElement& element, const RobotSemantics::JointSet& group,
                        const std::set<std::string>& virtual_joints, const XmlPlace& place,
                        NamedState& state) const {
    const std::string name = place.name(element, "name");
    if (name.empty() || virtual_joints.contains(name)) return;
    const auto found = tree_.by_joint.find(name);
    const XmlPlace line = place.at(element);
    if (found == tree_.by_joint.end()) {
      if (tree_.nameless) {
        static_cast<void>(line.of("joint " + name).number(element, "value", Presence::required));
        return;
      }
      return line.warn(
          "unknown-name",
          "joint " + name + " is not in " + tree_.file + "; it is left out of the state", name);
    }
    const TreeLink& link = tree_.links[found->second];
    if (!link.joint.is_independent() && !link.joint.held) return;  // it has no value
    const auto value = line.of("joint " + name).number(element, "value", Presence::required);
    if (!value) {
      state.unread.insert(found->second);
      return;
    }
    if (!group.contains(found->second)) {
      return line.warn("foreign-joint",
                       "joint " + name + " is not in the group; it is left out of the state", name);
    }
    if (!state.values.emplace(found->second, *value).second) {
      line.report("duplicate-name", "joint " + name + " has more than one value", name);
    }
  }

  std::optional<std::size_t> link_at(const XMLElement& element, const char* attribute) {
    const std::string name = at_line(element)
                                 .only_warning("the links of the pair stay checked")
                                 .name(element, attribute);
    if (name.empty()) return std::nullopt;
    const auto found = tree_.by_link.find(name);
    if (found != tree_.by_link.end()) return found->second;
    if (tree_.nameless) return std::nullopt;
    StaleElements& stale = stale_[element.Name()];
    if (last_stale_ != &element) ++stale.stale;
    last_stale_ = &element;
    if (stale.stale <= 3) {
      stale.examples += (stale.examples.empty() ? "" : ", ") + name + " at line " +
                        std::to_string(element.GetLineNum());
    }
    return std::nullopt;
  }

  void warn_of_stale_elements() const {
    for (const auto& [tag, stale] : stale_) {
      if (stale.stale == 0) continue;
      XmlPlace(file_, 0, tag, diagnostics_)
          .warn("unknown-name", std::to_string(stale.stale) + " of " + std::to_string(stale.all) +
                                    " name links that are not in " + tree_.file + " (" +
                                    stale.examples + (stale.stale > 3 ? ", ..." : "") +
                                    "); they are left out, and the intended links stay checked");
    }
  }

  template <class Visit>
  void for_each_pair(const char* tag, Visit visit) {
    for_each(tag, [&](const XMLElement& element) {
      ++stale_[tag].all;
      const auto a = link_at(element, "link1");
      const auto b = link_at(element, "link2");
      if (!a || !b) return;
      if (a == b) {
        return at_line(element).warn(
            "same-link", "link1 and link2 are the same link; it is left out", tree_.links[*a].name);
      }
      visit(std::pair<std::size_t, std::size_t>(std::minmax(*a, *b)), element.GetLineNum());
    });
  }

  void read_allowed_pairs(RobotSemantics& semantics) {
    for_each("disable_default_collisions", [&](const XMLElement& element) {
      ++stale_[element.Name()].all;
      const auto link = link_at(element, "link");
      for (std::size_t other = 0; link && other < tree_.links.size(); ++other) {
        if (other != *link)
          semantics.allowed_pairs.emplace(std::minmax(*link, other), element.GetLineNum());
      }
    });
    for_each_pair("enable_collisions",
                  [&](const auto& pair, int) { semantics.allowed_pairs.erase(pair); });
    for_each_pair("disable_collisions",
                  [&](const auto& pair, int line) { semantics.allowed_pairs.emplace(pair, line); });
  }

  const XMLElement& srdf_;
  std::string file_;
  const RobotTree& tree_;
  Diagnostics& diagnostics_;
  std::map<std::string, StaleElements> stale_;  // by tag
  const XMLElement* last_stale_ = nullptr;
};

}  // namespace

std::optional<RobotSemantics> read_srdf(std::string text, const std::filesystem::path& path,
                                        const RobotTree& tree,
                                        const std::set<std::string>& used_groups,
                                        const std::string& prefix, Diagnostics& diagnostics) {
  const std::string file = told_file_name(path);
  tinyxml2::XMLDocument document;
  auto* srdf = parse_robot_xml(text, file, document, diagnostics);
  if (srdf == nullptr) return std::nullopt;
  const SrdfNames names = names_in_srdf(*srdf);
  const auto mismatch = find_prefix_mismatch(names.links, names.joints, tree);
  if (mismatch && !mismatch->lacking.contains(prefix)) {
    XmlPlace(file, srdf->GetLineNum(), "robot", diagnostics)
        .report("other-prefix", to_text(*mismatch, file, "srdf_prefix", tree));
    return std::nullopt;
  }
  prepend_to_names(prefix, *srdf);
  RobotSemantics semantics = SrdfReader(*srdf, file, tree, diagnostics).read(used_groups);
  semantics.file = file;
  semantics.text = std::move(text);
  return semantics;
}

}  // namespace armloom
