#include "server/import/imported_robot.h"

#include <tinyxml2.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "core/model/srdf/joint_limits_file.h"
#include "core/model/srdf/srdf_reader.h"
#include "core/model/urdf/robot_tree.h"
#include "core/model/urdf/urdf_reader.h"
#include "core/model/xml/robot_file.h"
#include "server/import/homes.h"

namespace armloom {
namespace {

// Cautious guesses, within the limits of any real robot.
constexpr double kAngle_rad = 1.0;
constexpr double kSpeed_rad_s = 0.5;
constexpr double kLength_m = 0.1;
constexpr double kSpeed_m_s = 0.05;

// Returns cautious guesses, by joint, of required limits that neither the URDF nor
// joint_limits.yaml (`file`, may be null) gives. The user must replace them.
std::map<std::string, JointLimitsDescription> guess_limits(const RobotTree& tree,
                                                           const RobotSemantics::JointSet& joints,
                                                           const LimitsFile* file) {
  std::map<std::string, JointLimitsDescription> guesses;
  for (const std::size_t index : joints) {
    const TreeLink& link = tree.links[index];
    if (!link.joint.is_independent()) continue;
    JointLimitsDescription filed;
    if (file != nullptr) {
      const auto found = file->joints.find(link.joint.name);
      if (found != file->joints.end()) filed = found->second.limits;
    }
    const bool slides = link.joint.motion == JointKind::prismatic;
    const UrdfLimits& urdf = link.joint.limits;
    JointLimitsDescription guess;
    if (!urdf.velocity && !filed.velocity) guess.velocity = slides ? kSpeed_m_s : kSpeed_rad_s;
    // If only one bound is given, URDF takes zero for the other.
    const bool bounded = urdf.lower || urdf.upper || filed.lower || filed.upper;
    if (link.joint.motion != JointKind::continuous && !bounded) {
      guess.lower = slides ? 0.0 : -kAngle_rad;
      guess.upper = slides ? kLength_m : kAngle_rad;
    }
    if (slides) guess.keys = {"velocity_m_s", "lower_m", "upper_m"};
    if (guess.velocity || guess.lower) guesses[link.joint.name] = guess;
  }
  return guesses;
}

std::string name_in(const std::string& urdf_text) {
  tinyxml2::XMLDocument document;
  document.Parse(urdf_text.data(), urdf_text.size());
  const auto* robot = document.RootElement();
  const char* name = robot == nullptr ? nullptr : robot->Attribute("name");
  return name == nullptr || *name == '\0' ? "robot" : name;
}

// Returns the joint with its value in an SRDF state, preferably a state that is named like a home.
// If no state contains the joint, its value is zero, or the limit nearest to zero.
HeldJoint hold(const RobotTree& tree, const RobotSemantics& semantics, std::size_t joint) {
  const TreeLink& link = tree.links[joint];
  double nearest_to_zero = std::max(0.0, link.joint.limits.lower.value_or(0.0));
  if (link.joint.limits.upper)
    nearest_to_zero = std::min(nearest_to_zero, *link.joint.limits.upper);
  HeldJoint held{link.joint.name, nearest_to_zero, {}};
  std::size_t best = 0;
  for (const auto& [group, states] : semantics.states) {
    for (const auto& [name, state] : states) {
      const auto value = state.values.find(joint);
      if (value == state.values.end()) continue;
      if (!held.state.empty() && home_rank(name) >= best) continue;
      held = {link.joint.name, value->second, name};
      best = home_rank(name);
    }
  }
  return held;
}

// Returns the problem that no group is an arm. Adds warnings about SRDF names that the URDF lacks,
// which are the most frequent cause.
tl::unexpected<Problems> no_arm(const RobotSemantics& semantics,
                                const std::vector<GroupChoice>& choices, const Problems& warnings) {
  std::string why;
  for (const GroupChoice& choice : choices) {
    why += (why.empty() ? ": " : "; ") + choice.group + ": " + choice.why;
  }
  Problems problems{{ProblemKind::invalid,
                     "no-arm",
                     semantics.file + ": robot",
                     semantics.file + ": robot: no group is an arm" +
                         (choices.empty() ? ", because the file has no groups" : why),
                     {}}};
  std::ranges::copy_if(warnings, std::back_inserter(problems), [](const Problem& warning) {
    return warning.slug == "unknown-name" || warning.slug == "other-robot";
  });
  return failure(std::move(problems));
}

// Replaces the problems of meshes in missing packages by one problem for each package.
void tell_missing_packages(const ImportedRobot& robot, Problems& problems) {
  Problems of_packages;
  for (const auto& [package, missing] : robot.packages.missing) {
    const std::size_t all = problems.size();
    std::erase_if(problems, [&, &meshes = missing.meshes](const Problem& problem) {
      const auto* mesh = std::get_if<std::string>(&problem.value);
      return problem.slug == "mesh-unresolved" && mesh != nullptr && meshes.contains(*mesh);
    });
    if (problems.size() == all) continue;  // only visuals
    of_packages.push_back({ProblemKind::invalid,
                           "package-missing",
                           "--package",
                           to_text(package, missing, robot.files.urdf, robot.packages.unused),
                           {}});
  }
  problems.insert(problems.begin(), of_packages.begin(), of_packages.end());
}

}  // namespace

Result<ImportedRobot> read_imported_robot(const RobotFiles& files,
                                          const std::map<std::string, std::string>& packages) {
  Diagnostics diagnostics;
  auto urdf = load_robot_file(files.urdf, "--urdf", "the robot", diagnostics);
  auto srdf = load_robot_file(files.srdf, "--srdf", "the robot", diagnostics);
  std::optional<std::string> limits;
  if (!files.joint_limits.empty())
    limits = load_robot_file(files.joint_limits, "--joint-limits", "the robot", diagnostics);
  if (diagnostics.count() > 0) return failure(diagnostics.take());

  ImportedRobot robot{.files = files};
  robot.name = name_in(*urdf);
  robot.packages = find_packages(*urdf, files.urdf, packages, installed_package_folders());
  auto tree = read_urdf(*std::move(urdf), files.urdf, robot.packages.folders, diagnostics);
  if (!tree) tree = unread_robot(files.urdf);
  const auto semantics =
      read_srdf(*std::move(srdf), files.srdf, *tree, {}, files.srdf_prefix, diagnostics);
  std::optional<LimitsFile> limits_file;
  if (limits) {
    limits_file =
        read_limits_file(*limits, files.joint_limits, files.joint_limits_prefix, diagnostics);
  }
  if (diagnostics.count() > 0) {
    Problems problems = diagnostics.take();
    tell_missing_packages(robot, problems);
    return failure(std::move(problems));
  }

  const auto choices = choose_arm_groups(*tree, *semantics, read_group_names(semantics->text));
  const auto held = joints_above_arms(*tree, *semantics, choices);
  for (const GroupChoice& choice : choices) {
    if (!choice.is_arm) {
      robot.left_out.push_back(choice);
      continue;
    }
    robot.arms.push_back(choice.group);
    RobotSemantics::JointSet moving;
    std::ranges::set_difference(semantics->groups.at(choice.group), held,
                                std::inserter(moving, moving.end()));
    robot.guesses.push_back(guess_limits(*tree, moving, limits_file ? &*limits_file : nullptr));
  }
  if (robot.arms.empty()) return no_arm(*semantics, choices, diagnostics.take_warnings());
  for (const std::size_t joint : held) robot.held.push_back(hold(*tree, *semantics, joint));
  return robot;
}

}  // namespace armloom
