#include "core/model/srdf_groups.h"

#include <tinyxml2.h>

#include <string_view>
#include <vector>

#include "core/model/xml_element.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;
using JointSet = RobotSemantics::JointSet;

struct Group {
  JointSet joints;
  std::vector<std::string> subgroups;
  enum class Mark { fresh, open, done } mark = Mark::fresh;
};

class GroupReader {
 public:
  GroupReader(const std::string& file, const RobotTree& tree,
              const std::set<std::string>& virtual_joints, Findings& findings)
      : file_(file), tree_(tree), virtual_joints_(virtual_joints), findings_(findings) {}

  void read(const XMLElement& element) {
    const XmlPlace at_line(file_ + ": group at line " + std::to_string(element.GetLineNum()),
                           findings_);
    const std::string name = at_line.name(element, "name");
    if (name.empty()) return;
    const XmlPlace place = place_of(name);
    const auto [entry, first] = groups_.emplace(name, Group{});
    if (!first) return place.report("duplicate-name", "more than one group has this name", name);
    place.only_children(element, {"chain", "joint", "link", "group", "passive_joint"});
    for (const auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      read_member(*child, place, entry->second);
    }
  }

  std::map<std::string, JointSet> resolve() {
    std::map<std::string, JointSet> resolved;
    for (auto& [name, group] : groups_) resolved[name] = joints_of(name, group);
    return resolved;
  }

 private:
  XmlPlace place_of(const std::string& group) const {
    return {file_ + ": group " + group, findings_};
  }

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
    if (found == index.end()) {
      return place.report("unknown-name",
                          std::string(tag) + " " + name + " is not in " + tree_.file, name);
    }
    add(found->second, group);
  }

  void add_chain(const XMLElement& chain, const XmlPlace& place, Group& group) const {
    const auto base = link_at(chain, "base_link", place);
    const auto tip = link_at(chain, "tip_link", place);
    if (!base || !tip) return;
    JointSet joints;
    std::optional<std::size_t> link = *tip;
    for (; link && *link != *base; link = tree_.links[*link].parent) joints.insert(*link);
    if (!link) {
      return place.report("broken-chain",
                          "tip_link " + tree_.links[*tip].name + " is not below base_link " +
                              tree_.links[*base].name,
                          tree_.links[*tip].name);
    }
    for (const std::size_t joint : joints) add(joint, group);
  }

  std::optional<std::size_t> link_at(const XMLElement& chain, const char* end,
                                     const XmlPlace& place) const {
    const std::string name = place.name(chain, end);
    if (name.empty()) return std::nullopt;
    const auto found = tree_.by_link.find(name);
    if (found != tree_.by_link.end()) return found->second;
    place.report("unknown-name",
                 "chain " + std::string(end) + " " + name + " is not in " + tree_.file, name);
    return std::nullopt;
  }

  void add(std::size_t joint, Group& group) const {
    if (tree_.links[joint].is_independent()) group.joints.insert(joint);
  }

  // Joints of the group and of all groups below it. A group met while it is open holds itself.
  const JointSet& joints_of(const std::string& name, Group& group) {
    if (group.mark != Group::Mark::fresh) return group.joints;
    group.mark = Group::Mark::open;
    for (const auto& subgroup : group.subgroups) {
      const auto found = groups_.find(subgroup);
      if (found == groups_.end()) {
        place_of(name).report("unknown-name", "group " + subgroup + " does not exist", subgroup);
      } else if (found->second.mark == Group::Mark::open) {
        place_of(name).report("group-cycle", "group " + subgroup + " holds this group too: a cycle",
                              subgroup);
      } else {
        const JointSet& below = joints_of(subgroup, found->second);
        group.joints.insert(below.begin(), below.end());
      }
    }
    group.mark = Group::Mark::done;
    return group.joints;
  }

  const std::string& file_;
  const RobotTree& tree_;
  const std::set<std::string>& virtual_joints_;
  Findings& findings_;
  std::map<std::string, Group> groups_;
};

}  // namespace

std::map<std::string, JointSet> read_groups(const XMLElement& srdf, const std::string& file,
                                            const RobotTree& tree,
                                            const std::set<std::string>& virtual_joints,
                                            Findings& findings) {
  constexpr std::size_t kMaxGroups = 1000;  // also bounds how deep groups can hold each other
  GroupReader reader(file, tree, virtual_joints, findings);
  std::size_t count = 0;
  for (const auto* group = srdf.FirstChildElement("group"); group != nullptr;
       group = group->NextSiblingElement("group")) {
    if (++count > kMaxGroups) {
      XmlPlace(file + ": robot", findings)
          .report("too-many-groups", "more than " + std::to_string(kMaxGroups) + " groups", {},
                  ProblemKind::too_large);
      break;
    }
    reader.read(*group);
  }
  return reader.resolve();
}

}  // namespace armloom
