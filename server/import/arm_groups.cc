#include "server/import/arm_groups.h"

#include <tinyxml2.h>

#include <algorithm>
#include <optional>

#include "server/import/joint_sets.h"
#include "server/import/one_arm.h"

namespace armloom {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kFewestJoints = 3;

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// Result of weigh(): which of two groups cannot be an arm, and why. weigh() returns nullopt if both
// can be arms.
struct Loser {
  bool is_first;
  std::string why;
};
std::optional<Loser> weigh(const RobotTree& tree, const GroupChoice& first, const JointSet& a,
                           const GroupChoice& second, const JointSet& b) {
  if (a == b) return Loser{false, "it has the same joints as " + first.group};
  if (share_a_joint(a, b)) {
    if (share_a_torso(tree, a, b)) return std::nullopt;
    if (!holds(a, b) && !holds(b, a)) return Loser{false, "it shares joints with " + first.group};
    const bool first_is_larger = a.size() > b.size();
    const bool smaller_stays = 2 * std::min(a.size(), b.size()) >= std::max(a.size(), b.size());
    const std::string& other = first_is_larger == smaller_stays ? second.group : first.group;
    return Loser{first_is_larger == smaller_stays,
                 smaller_stays ? "it contains " + other + " and joints above or below it"
                               : "it is a part of " + other};
  }
  const bool first_above = is_above(tree, a, b);
  if (!first_above && !is_above(tree, b, a)) return std::nullopt;
  const std::size_t upper = first_above ? a.size() : b.size();
  const std::size_t lower = first_above ? b.size() : a.size();
  if (lower > upper) {
    return Loser{first_above, "it moves " + (first_above ? second.group : first.group)};
  }
  return Loser{!first_above, "it is moved by " + (first_above ? first.group : second.group)};
}

void leave_out(GroupChoice& choice, std::string why) {
  choice.is_arm = false;
  choice.why = std::move(why);
}

// Returns candidates that satisfy `is_part` and are side by side: none moves another. Prefers
// larger groups.
template <class IsPart>
std::vector<const GroupChoice*> side_by_side(const RobotTree& tree, const RobotSemantics& semantics,
                                             const std::vector<GroupChoice>& choices,
                                             const IsPart& is_part) {
  const auto joints_of = [&](const GroupChoice* choice) -> const JointSet& {
    return semantics.groups.at(choice->group);
  };
  std::vector<const GroupChoice*> candidates;
  for (const GroupChoice& choice : choices) {
    if (choice.is_arm && is_part(joints_of(&choice))) candidates.push_back(&choice);
  }
  std::ranges::stable_sort(candidates, [&](const GroupChoice* a, const GroupChoice* b) {
    return joints_of(a).size() > joints_of(b).size();
  });
  std::vector<const GroupChoice*> parts;
  for (const GroupChoice* one : candidates) {
    if (std::ranges::all_of(parts, [&](const GroupChoice* other) {
          return stand_side_by_side(tree, joints_of(other), joints_of(one));
        }))
      parts.push_back(one);
  }
  return parts;
}

std::string listed(const std::vector<const GroupChoice*>& choices) {
  std::vector<std::string> names;
  for (const GroupChoice* choice : choices) names.push_back(choice->group);
  return listed(names);
}

// Drops groups of several joints of which none moves another, such as wheels, if another group may
// be an arm.
void leave_out_wheels(const RobotTree& tree, const RobotSemantics& semantics,
                      std::vector<GroupChoice>& choices) {
  const auto are_side_by_side = [&](const GroupChoice& choice) {
    const JointSet& joints = semantics.groups.at(choice.group);
    return joints.size() > 1 && std::ranges::none_of(joints, [&](std::size_t joint) {
             return std::ranges::any_of(
                 joints, [&](std::size_t other) { return is_above(tree, {joint}, {other}); });
           });
  };
  const bool has_others = std::ranges::any_of(choices, [&](const GroupChoice& choice) {
    return choice.is_arm && !are_side_by_side(choice);
  });
  for (GroupChoice& choice : choices) {
    if (has_others && choice.is_arm && are_side_by_side(choice))
      leave_out(choice, "none of its joints moves another");
  }
}

// Drops groups that move two other groups side by side, each at least as large.
void leave_out_torsos(const RobotTree& tree, const RobotSemantics& semantics,
                      std::vector<GroupChoice>& choices) {
  for (GroupChoice& torso : choices) {
    const JointSet& joints = semantics.groups.at(torso.group);
    const auto moved = side_by_side(tree, semantics, choices, [&](const JointSet& part) {
      return part.size() >= joints.size() && !share_a_joint(joints, part) &&
             is_above(tree, joints, part);
    });
    if (torso.is_arm && moved.size() >= 2) leave_out(torso, "it moves " + listed(moved));
  }
}

// Drops groups that contain two or more other groups side by side, if these have at least half of
// the joints.
void leave_out_unions(const RobotTree& tree, const RobotSemantics& semantics,
                      std::vector<GroupChoice>& choices) {
  for (GroupChoice& whole : choices) {
    const JointSet& joints = semantics.groups.at(whole.group);
    const auto parts = side_by_side(tree, semantics, choices, [&](const JointSet& part) {
      return part.size() < joints.size() && holds(joints, part);
    });
    std::size_t held = 0;
    for (const GroupChoice* part : parts) held += semantics.groups.at(part->group).size();
    if (whole.is_arm && parts.size() >= 2 && 2 * held >= joints.size())
      leave_out(whole, "it is made of " + listed(parts));
  }
}

// Keeps a group whose parts are one arm only together (is_one_arm()), and drops the parts. Drops
// any other group that names subgroups.
void put_pieces_together(const RobotTree& tree, const RobotSemantics& semantics,
                         const GroupNames& names, std::vector<GroupChoice>& choices) {
  std::vector<GroupChoice*> smallest_first;
  for (GroupChoice& choice : choices) smallest_first.push_back(&choice);
  const auto joints_of = [&](const GroupChoice& choice) -> const JointSet& {
    return semantics.groups.at(choice.group);
  };
  std::ranges::stable_sort(smallest_first, {},
                           [&](const GroupChoice* choice) { return joints_of(*choice).size(); });
  for (GroupChoice* whole : smallest_first) {
    if (!whole->is_arm) continue;
    const JointSet& joints = joints_of(*whole);
    if (is_one_arm(*whole, tree, semantics, names, choices)) {
      for (GroupChoice& part : choices) {
        if (part.is_arm && joints_of(part).size() < joints.size() && holds(joints, joints_of(part)))
          leave_out(part, "it is a part of " + whole->group);
      }
    } else if (const auto parts = names.parts.find(whole->group); parts != names.parts.end()) {
      leave_out(*whole, "it is made of " + listed(parts->second));
    }
  }
}

}  // namespace

GroupNames read_group_names(const std::string& srdf_text) {
  GroupNames names;
  tinyxml2::XMLDocument document;
  document.Parse(srdf_text.data(), srdf_text.size());
  const XMLElement* robot = document.RootElement();
  if (robot == nullptr) return names;
  for (const auto* element = robot->FirstChildElement(); element != nullptr;
       element = element->NextSiblingElement()) {
    const std::string tag = element->Name();
    if (tag == "end_effector") names.end_effectors.insert(attribute(*element, "group"));
    if (tag != "group") continue;
    const std::string group = attribute(*element, "name");
    names.in_order.push_back(group);
    for (const auto* part = element->FirstChildElement("group"); part != nullptr;
         part = part->NextSiblingElement("group")) {
      names.parts[group].push_back(attribute(*part, "name"));
    }
  }
  return names;
}

std::vector<GroupChoice> choose_arm_groups(const RobotTree& tree, const RobotSemantics& semantics,
                                           const GroupNames& names) {
  std::vector<GroupChoice> choices;
  const auto joints_of = [&](const GroupChoice& choice) -> const JointSet& {
    return semantics.groups.at(choice.group);
  };
  for (const std::string& group : names.in_order) {
    const auto known = semantics.groups.find(group);
    if (known == semantics.groups.end()) continue;
    GroupChoice choice{.group = group, .is_arm = true, .why = {}};
    const auto parts = names.parts.find(group);
    if (parts != names.parts.end() && !is_chain(tree, known->second)) {
      leave_out(choice, "it is made of " + listed(parts->second));
    } else if (known->second.empty()) {
      leave_out(choice, "it has no movable joint");
    } else if (names.end_effectors.contains(group)) {
      leave_out(choice, "it is an end effector");
    }
    choices.push_back(std::move(choice));
  }
  leave_out_wheels(tree, semantics, choices);
  leave_out_torsos(tree, semantics, choices);
  put_pieces_together(tree, semantics, names, choices);
  leave_out_unions(tree, semantics, choices);
  for (std::size_t a = 0; a < choices.size(); ++a) {
    for (std::size_t b = a + 1; b < choices.size() && choices[a].is_arm; ++b) {
      if (!choices[b].is_arm) continue;
      auto loser =
          weigh(tree, choices[a], joints_of(choices[a]), choices[b], joints_of(choices[b]));
      if (loser) leave_out(choices[loser->is_first ? a : b], std::move(loser->why));
    }
  }
  const auto is_large = [&](const GroupChoice& choice) {
    return choice.is_arm && joints_of(choice).size() >= kFewestJoints;
  };
  if (std::ranges::any_of(choices, is_large)) {
    for (GroupChoice& choice : choices) {
      if (!choice.is_arm || is_large(choice)) continue;
      leave_out(choice, "it has only " + std::to_string(joints_of(choice).size()) +
                            (joints_of(choice).size() == 1 ? " joint" : " joints"));
    }
  }
  return choices;
}

std::set<std::size_t> joints_above_arms(const RobotTree& tree, const RobotSemantics& semantics,
                                        const std::vector<GroupChoice>& choices) {
  JointSet of_arms;
  std::set<std::size_t> above;
  for (const GroupChoice& choice : choices) {
    if (!choice.is_arm) continue;
    for (const std::size_t joint : semantics.groups.at(choice.group)) {
      if (!of_arms.insert(joint).second) above.insert(joint);
    }
  }
  for (const std::size_t joint : of_arms) {
    for (auto link = tree.links[joint].parent; link; link = tree.links[*link].parent) {
      // A mimic joint moves with the joint that it follows.
      const auto& mimic = tree.links[*link].joint.mimic;
      const std::size_t driver = mimic ? mimic->driver : *link;
      if (tree.links[driver].joint.is_independent() && !of_arms.contains(driver))
        above.insert(driver);
    }
  }
  return above;
}

}  // namespace armloom
