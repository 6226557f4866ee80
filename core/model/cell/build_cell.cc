#include "core/model/cell/build_cell.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "core/base/diagnostics.h"
#include "core/geometry/mesh/mesh.h"
#include "core/model/cell/cell_checks.h"
#include "core/model/cell/cell_warnings.h"
#include "core/model/cell/robot_build.h"
#include "core/model/cell/setting_warnings.h"
#include "core/model/urdf/hold_joints.h"
#include "core/model/urdf/mesh_path.h"
#include "core/model/urdf/urdf_reader.h"
#include "core/model/xml/robot_file.h"

namespace armloom {
namespace {

// Loads the triangles of a mesh shape.
void load_mesh_of(Shape& shape, const std::string& pointer, const std::string& whose,
                  MeshCache& meshes, Diagnostics& diagnostics) {
  auto* mesh = std::get_if<Mesh>(&shape);
  if (mesh == nullptr) return;
  auto data = meshes.get(mesh->path, mesh->scale, pointer, whose);
  if (data) {
    mesh->data = *std::move(data);
    return;
  }
  for (Problem& problem : data.error()) diagnostics.add(std::move(problem));
}

void load_meshes_of(RobotTree& tree, MeshCache& meshes, Diagnostics& diagnostics) {
  for (TreeLink& link : tree.links) {
    const std::string place = tree.place_of_link(link);
    for (PlacedShape& placed : link.shapes)
      load_mesh_of(placed.shape, place, place, meshes, diagnostics);
  }
}

void load_meshes_of_objects(Cell& cell, MeshCache& meshes, Diagnostics& diagnostics) {
  for (std::size_t o = 0; o < cell.objects.size(); ++o) {
    const auto* mesh = std::get_if<Mesh>(&cell.objects[o].shape);
    std::error_code error;
    // Faulty mesh objects are not loaded: check_objects has reported them.
    if (mesh == nullptr || !std::filesystem::is_regular_file(mesh->path, error)) continue;
    if (!mesh->scale.allFinite() || (mesh->scale.array() == 0.0).any()) continue;
    load_mesh_of(cell.objects[o].shape, "/objects/" + std::to_string(o) + "/mesh",
                 "object " + cell.objects[o].name, meshes, diagnostics);
  }
}

std::set<std::string> used_groups(const RobotDescription& robot) {
  std::set<std::string> groups;
  for (const ArmDescription& arm : robot.arms) groups.insert(arm.group);
  return groups;
}

// Reads the robot's files as far as possible. If the URDF is unreadable, the tree is empty and the
// names of links and joints are unknown. The other files are still checked against each other.
RobotBuild read_robot(const RobotDescription& description, std::size_t index, MeshCache& meshes,
                      Diagnostics& diagnostics) {
  const std::string pointer = "/robots/" + std::to_string(index);
  const auto load = [&](const std::string& path, const char* key) {
    return path.empty() ? std::nullopt
                        : load_robot_file(path, pointer + "/" + key, "robot " + description.name,
                                          diagnostics);
  };
  auto urdf = load_robot_file(description.urdf, pointer + "/urdf", "robot " + description.name,
                              diagnostics);
  auto srdf = load(description.srdf, "srdf");
  const auto limits = load(description.joint_limits, "joint_limits");
  auto limits_file = limits ? read_limits_file(*limits, description.joint_limits,
                                               description.joint_limits_prefix, diagnostics)
                            : std::nullopt;
  auto tree = urdf
                  ? read_urdf(*std::move(urdf), description.urdf, description.packages, diagnostics)
                  : std::nullopt;
  if (!tree) tree = unread_robot(description.urdf);
  load_meshes_of(*tree, meshes, diagnostics);
  hold_joints(description.fixed, pointer, description.name, *tree, diagnostics);

  RobotBuild robot{.id = RobotId(static_cast<std::uint32_t>(index)),
                   .pointer = pointer,
                   .description = &description,
                   .tree = *std::move(tree),
                   .semantics = std::nullopt,
                   .limits_file = std::move(limits_file),
                   .links = {},
                   .joints = {},
                   .arms = {},
                   .shared = {}};
  if (srdf) {
    robot.semantics = read_srdf(*std::move(srdf), description.srdf, robot.tree,
                                used_groups(description), description.srdf_prefix, diagnostics);
  }
  return robot;
}

std::string why_no_value(const RobotBuild& robot, const TreeLink& link) {
  if (link.joint.held) return "is held at " + text_of(*link.joint.held);
  if (!link.joint.mimic) return "is fixed";
  return "follows " + robot.description->prefix +
         robot.tree.links[link.joint.mimic->driver].joint.name;
}

void add_joints(RobotBuild& robot, Cell& cell) {
  Robot& added = cell.robots[robot.id.index()];
  for (const TreeLink& link : robot.tree.links) {
    if (!link.joint.is_independent()) {
      const std::string name = robot.description->prefix + link.joint.name;
      if (!link.joint.name.empty()) added.joints_without_value[name] = why_no_value(robot, link);
      robot.joints.push_back(std::nullopt);
      continue;
    }
    robot.joints.push_back(JointId(static_cast<std::uint32_t>(cell.joints.size())));
    cell.joints.push_back({.name = robot.description->prefix + link.joint.name,
                           .robot = robot.id,
                           .arm = std::nullopt,
                           .kind = *link.joint.motion,
                           .lower = 0.0,  // settle_limits() sets the limits
                           .upper = 0.0,
                           .velocity_max = kDefaultVelocity,
                           .acceleration_max = kDefaultAcceleration,
                           .jerk_max = kDefaultJerk,
                           .brake = 2.0 * kDefaultAcceleration});
  }
}

// Adds the robot's links to the cell. Precondition: the robot's joints are in the cell.
void add_links(RobotBuild& robot, Cell& cell) {
  for (std::size_t i = 0; i < robot.tree.links.size(); ++i) {
    TreeLink& source = robot.tree.links[i];
    Link link{.name = robot.description->prefix + source.name,
              .robot = robot.id,
              .arm = std::nullopt,
              .parent = std::nullopt,
              .X_PJ = source.joint.X_PJ,
              .driver = robot.joints[i],
              .motion = JointKind::revolute,
              .axis = source.joint.axis,
              .multiplier = 1.0,
              .offset = 0.0,
              .shapes = std::move(source.shapes)};
    if (source.parent)
      link.parent = robot.links[*source.parent];
    else
      link.X_PJ = robot.description->X_WB;
    if (source.joint.motion) link.motion = *source.joint.motion;
    if (source.joint.mimic) {
      link.driver = robot.joints[source.joint.mimic->driver];
      link.multiplier = source.joint.mimic->multiplier;
      link.offset = source.joint.mimic->offset;
    }
    robot.links.push_back(LinkId(static_cast<std::uint32_t>(cell.links.size())));
    cell.links.push_back(std::move(link));
  }
}

// Reports a link name and a joint name, with prefix, that another robot also has. Reports only one
// of each, because two robots of one URDF without prefixes share all names.
void check_prefixed_names(const RobotBuild& robot, std::set<std::string>& links,
                          std::set<std::string>& joints, Diagnostics& diagnostics) {
  const auto first_taken = [&](const auto& by_name, std::set<std::string>& known) {
    std::optional<std::string> taken;
    for (const auto& entry : by_name) {
      const std::string name = robot.description->prefix + entry.first;
      if (!known.insert(name).second && !taken) taken = name;
    }
    return taken;
  };
  const auto report = [&](const std::string& kind, const std::optional<std::string>& name) {
    if (!name) return;
    diagnostics.in_cell("duplicate-name", robot.pointer + "/prefix",
                        "robot " + robot.description->name + ": another robot also has a " + kind +
                            " named " + *name + "; give the robots different prefixes",
                        robot.description->prefix);
  };
  report("link", first_taken(robot.tree.by_link, links));
  report("joint", first_taken(robot.tree.by_joint, joints));
}

void check_objects_are_no_links(const CellDescription& description,
                                const std::set<std::string>& links, Diagnostics& diagnostics) {
  std::set<std::string> robots;
  for (const RobotDescription& robot : description.robots) robots.insert(robot.name);
  for (std::size_t o = 0; o < description.objects.size(); ++o) {
    const std::string& name = description.objects[o].name;
    const bool link = links.contains(name);
    if (!link && !robots.contains(name)) continue;
    diagnostics.in_cell("duplicate-name", "/objects/" + std::to_string(o) + "/name",
                        "the name " + name + " of an object is also a " +
                            (link ? "link" : "robot") + "'s name; rename the object",
                        name);
  }
}

void add_robot(RobotBuild robot, Cell& cell, Diagnostics& diagnostics) {
  Robot& added = cell.robots[robot.id.index()];
  added.urdf_text = robot.tree.text;
  added.mesh_files =
      mesh_files(robot.tree.text, std::filesystem::path(robot.description->urdf).parent_path(),
                 robot.description->packages);
  if (robot.semantics) added.srdf_text = robot.semantics->text;
  add_joints(robot, cell);
  add_links(robot, cell);
  const bool groups_known = robot.semantics || robot.description->srdf.empty();
  if (groups_known) {
    add_arms(robot, cell, diagnostics);
    assign_to_arms(robot, cell);
    refuse_shared_joints(robot, cell, diagnostics);
    tell_standing_joints(robot, cell, diagnostics);
    warn_of_passive_joints(robot, cell, diagnostics);
    warn_of_seen_only(robot, cell, diagnostics);
  }
  settle_limits(robot, cell, diagnostics);
  if (groups_known) settle_homes(robot, cell, diagnostics);
  allow_pairs_of_robot(robot, cell);
}

void copy_settings(const CellDescription& description, Cell& cell) {
  cell.name = description.name;
  cell.clearances.clearance_m = description.clearance_m;
  cell.clearances.self_clearance_m =
      std::min(description.self_clearance_m, description.clearance_m);
  cell.clearances.mount_clearance_m = description.mount_clearance_m;
  cell.checking = description.checking;
  cell.scheduling = description.scheduling;
  cell.monitor = description.monitor;
  cell.execution = description.execution;
  cell.io = description.io;
  for (const auto& object : description.objects)
    cell.objects.push_back({object.name, object.shape, object.X_WO, object.mass});
  for (const auto& robot : description.robots) {
    cell.robots.push_back({.name = robot.name,
                           .prefix = robot.prefix,
                           .srdf_prefix = robot.srdf_prefix,
                           .X_WB = robot.X_WB,
                           .arms = {},
                           .urdf_text = {},
                           .srdf_text = {},
                           .controller = robot.controller,
                           .mesh_files = {}});
  }
}

void require_an_arm(const CellDescription& description, Diagnostics& diagnostics) {
  if (description.robots.empty())
    return diagnostics.in_cell("no-robot", "/robots", "the cell has no robot");
  for (const auto& robot : description.robots) {
    if (!robot.arms.empty()) return;
  }
  diagnostics.in_cell("no-arm", "/robots/0/arms", "no robot of the cell has an arm");
}

}  // namespace

Result<CellPtr> build_cell(const CellDescription& description) {
  Problems warnings;
  return build_cell(description, warnings);
}

Result<CellPtr> build_cell(const CellDescription& description, Problems& warnings) {
  Diagnostics diagnostics;
  require_an_arm(description, diagnostics);
  check_names(description, diagnostics);
  check_objects(description, diagnostics);
  check_settings(description, diagnostics);
  check_io(description.io, diagnostics);

  auto cell = std::make_shared<Cell>();
  copy_settings(description, *cell);
  MeshCache meshes;
  load_meshes_of_objects(*cell, meshes, diagnostics);
  std::set<std::string> links;
  std::set<std::string> joints;
  bool complete = true;
  for (std::size_t r = 0; r < description.robots.size(); ++r) {
    const RobotDescription& robot = description.robots[r];
    check_pose(robot.X_WB, "/robots/" + std::to_string(r) + "/base",
               "robot " + robot.name + ": base", diagnostics);
    RobotBuild build = read_robot(robot, r, meshes, diagnostics);
    complete = complete && !build.tree.nameless;
    check_prefixed_names(build, links, joints, diagnostics);
    add_robot(std::move(build), *cell, diagnostics);
  }
  check_objects_are_no_links(description, links, diagnostics);
  // If some link names could not be read, valid pairs with these names would be reported as
  // unknown.
  if (complete) allow_pairs_of_cell(description, *cell, diagnostics);
  warn_of_cell(description, *cell, diagnostics);
  warn_of_settings(description, *cell, diagnostics);

  warnings = diagnostics.take_warnings();
  if (diagnostics.count() > 0) return failure(diagnostics.take());
  return CellPtr(std::move(cell));
}

}  // namespace armloom
