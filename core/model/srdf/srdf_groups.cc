#include "core/model/srdf/srdf_groups.h"

#include <tinyxml2.h>

#include <string_view>
#include <vector>

#include "core/model/xml/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;
using JointSet = RobotSemantics::JointSet;

struct Group {
  JointSet joints;
  std::vector<std::string> subgroups;
  int line = 0;
  Diagnostics faults;  // problems if the group is used, warnings if not
  enum class Mark { fresh, open, done } mark = Mark::fresh;
};

class GroupReader {
 public:
  GroupReader(const std::string& file, const RobotTree& tree,
              const std::set<std::string>& virtual_joints, Diagnostics& diagnostics)
      : file_(file), tree_(tree), virtual_joints_(virtual_joints), diagnostics_(diagnostics) {}

  void read(const XMLElement& element) {
    const XmlPlace nameless(file_, element.GetLineNum(), "group", diagnostics_);
    const std::string name =
        nameless.only_warning("no arm can be this group").name(element, "name");
    if (name.empty()) return;
    const auto [entry, first] = groups_.emplace(name, Group{});
    const XmlPlace place(file_, element.GetLineNum(), "group " + name, entry->second.faults);
    if (!first) return place.report("duplicate-name", "more than one group has this name", name);
    entry->second.line = element.GetLineNum();
    place.only_children(element, {"chain", "joint", "link", "group"}, {"passive_joint"});
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      read_member(*child, place, entry->second);
    }
  }

  std::map<std::string, JointSet> resolve(const std::set<std::string>& used) {
    std::map<std::string, JointSet> resolved;
    for (auto& [name, group] : groups_) resolved[name] = joints_of(name, group);
    for (const std::string& name : used) tell_faults(name);
    for (auto& [name, group] : groups_) diagnostics_.merge_as_warnings(std::move(group.faults));
    return resolved;
  }

 private:
  void read_member(const XMLElement& member, const XmlPlace& place, Group& group) {
    const std::string_view tag = member.Name();
    if (tag == "chain") return add_chain(member, place, group);
    if (tag != "joint" && tag != "link" && tag != "group") return;
    const std::string name = place.name(member, "name");
    if (name.empty()) return;
    if (tag == "group") return group.subgroups.push_back(name);
    if (tag == "joint" && virtual_joints_.contains(name)) return;
    const auto& index = tag == "joint" ? tree_.by_joint : tree_.by_link;
    const auto found = index.find(name);
    if (found == index.end()) return warn_unknown(std::string(tag), name, place.at(member));
    add(found->second, place.at(member), group);
  }

  void warn_unknown(const std::string& what, const std::string& name, const XmlPlace& place) const {
    if (tree_.nameless) return;
    place.warn("unknown-name",
               what + " " + name + " is not in " + tree_.file + "; it is left out of the group",
               name);
  }

  void add_chain(const XMLElement& chain, const XmlPlace& place, Group& group) const {
    const auto base = link_at(chain, "base_link", place);
    const auto tip = link_at(chain, "tip_link", place);
    if (!base || !tip) return;
    JointSet joints;
    std::optional<std::size_t> link = *tip;
    for (; link && *link != *base; link = tree_.links[*link].parent) joints.insert(*link);
    if (!link) {
      if (tree_.patched) return;  // links may be misplaced
      return place.at(chain).report("broken-chain",
                                    "tip_link " + tree_.links[*tip].name +
                                        " is not below base_link " + tree_.links[*base].name,
                                    tree_.links[*tip].name);
    }
    for (const std::size_t joint : joints) add(joint, place.at(chain), group);
  }

  std::optional<std::size_t> link_at(const XMLElement& chain, const char* end,
                                     const XmlPlace& place) const {
    const std::string name = place.name(chain, end);
    if (name.empty()) return std::nullopt;
    const auto found = tree_.by_link.find(name);
    if (found != tree_.by_link.end()) return found->second;
    warn_unknown("chain " + std::string(end), name, place.at(chain));
    return std::nullopt;
  }

  void add(std::size_t joint, const XmlPlace& place, Group& group) const {
    const TreeLink& link = tree_.links[joint];
    if (link.joint.many_values) {
      place.report(
          "unsupported-joint",
          "joint " + link.joint.name + " is floating or planar, which an arm cannot contain",
          link.joint.name, ProblemKind::unsupported);
    } else if (link.joint.is_independent() || link.joint.held) {
      group.joints.insert(joint);
    }
  }

  // Returns the joints of the group and of its subgroups. A group that is reached while it is still
  // open contains itself.
  const JointSet& joints_of(const std::string& name, Group& group) {
    if (group.mark != Group::Mark::fresh) return group.joints;
    group.mark = Group::Mark::open;
    for (const auto& subgroup : group.subgroups) {
      const XmlPlace place(file_, group.line, "group " + name, group.faults);
      const auto found = groups_.find(subgroup);
      if (found == groups_.end()) {
        place.warn("unknown-name",
                   "group " + subgroup + " does not exist; it is left out of the group", subgroup);
      } else if (found->second.mark == Group::Mark::open) {
        place.report("group-cycle", "group " + subgroup + " also contains this group: a cycle",
                     subgroup);
      } else {
        const JointSet& below = joints_of(subgroup, found->second);
        group.joints.insert(below.begin(), below.end());
      }
    }
    group.mark = Group::Mark::done;
    return group.joints;
  }

  // Reports the faults of a used group and of its subgroups, each fault once.
  void tell_faults(const std::string& name) {
    const auto found = groups_.find(name);
    if (found == groups_.end() || !told_.insert(name).second) return;
    diagnostics_.merge(std::exchange(found->second.faults, {}));
    for (const auto& subgroup : found->second.subgroups) tell_faults(subgroup);
  }

  const std::string& file_;
  const RobotTree& tree_;
  const std::set<std::string>& virtual_joints_;
  Diagnostics& diagnostics_;
  std::map<std::string, Group> groups_;
  std::set<std::string> told_;
};

}  // namespace

std::map<std::string, JointSet> read_groups(const XMLElement& srdf, const std::string& file,
                                            const RobotTree& tree, const GroupNames& names,
                                            Diagnostics& diagnostics) {
  constexpr std::size_t kMaxGroups = 1000;  // also bounds the nesting of groups
  GroupReader reader(file, tree, names.virtual_joints, diagnostics);
  std::size_t count = 0;
  for (const auto* group = srdf.FirstChildElement("group"); group != nullptr;
       group = group->NextSiblingElement("group")) {
    if (++count > kMaxGroups) {
      XmlPlace(file, group->GetLineNum(), "robot", diagnostics)
          .report("too-many-groups", "more than " + std::to_string(kMaxGroups) + " groups", {},
                  ProblemKind::too_large);
      break;
    }
    reader.read(*group);
  }
  return reader.resolve(names.used);
}

}  // namespace armloom
