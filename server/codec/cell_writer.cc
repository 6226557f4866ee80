#include <Eigen/Geometry>
#include <algorithm>

#include "server/codec/cell_codec.h"
#include "server/codec/cell_format.h"
#include "server/codec/mesh_address.h"
#include "server/codec/pose_words.h"
#include "server/codec/scene_format.h"

namespace armloom {
namespace {

void write_vector(JsonWriter& out, const Eigen::VectorXd& numbers) {
  out.begin_array();
  for (const double number : numbers) out.value(number);
  out.end_array();
}

void write_pose(JsonWriter& out, const Eigen::Isometry3d& X) {
  const PoseWords words = pose_in_words(X);
  out.key("xyz");
  write_vector(out, words.xyz_m);
  out.key("rpy");
  write_vector(out, words.rpy_rad);
}

void write_arm(JsonWriter& out, const Cell& cell, const Arm& arm) {
  out.begin_object().field("name", arm.name).field("group", arm.group);
  out.key("joints").begin_array();
  for (const JointId id : arm.joints) out.value(cell.joint(id).name);
  out.end_array().key("gripper_joints").begin_array();
  for (const JointId id : arm.gripper_joints) out.value(cell.joint(id).name);
  out.end_array().key("home");
  write_vector(out, arm.home);
  out.key("named_states").begin_object();
  for (const auto& [name, q] : arm.named_states) {
    out.key(name);
    write_vector(out, q);
  }
  out.end_object().end_object();
}

void write_robot(JsonWriter& out, const Cell& cell, const Robot& robot) {
  out.begin_object().field("name", robot.name).field("prefix", robot.prefix);
  out.key("base").begin_object();
  write_pose(out, robot.X_WB);
  out.end_object();
  out.field("urdf", robot.urdf_text).field("srdf", robot.srdf_text);
  out.key("meshes").begin_object();
  for (const auto& [uri, path] : robot.mesh_files) out.field(uri, mesh_address(path));
  out.end_object();
  out.key("arms").begin_array();
  for (const ArmId id : robot.arms) write_arm(out, cell, cell.arm(id));
  out.end_array().end_object();
}

void write_joint(JsonWriter& out, const Cell& cell, const Joint& joint) {
  out.begin_object().field("name", joint.name);
  out.key("arm");
  if (joint.arm) {
    out.value(cell.arm(*joint.arm).name);
  } else {
    out.value(nullptr);
  }
  out.field("lower", joint.lower).field("upper", joint.upper);
  out.field("velocity_max", joint.velocity_max).field("acceleration_max", joint.acceleration_max);
  out.field("jerk_max", joint.jerk_max).field("brake", joint.brake);
  out.field("unit", joint.kind == JointKind::prismatic ? "m" : "rad").end_object();
}

void write_settings(JsonWriter& out, const Cell& cell) {
  CellDescription settings;
  settings.clearance_m = cell.clearance_m;
  settings.self_clearance_m = cell.self_clearance_m;
  settings.mount_clearance_m =
      std::min(cell.mount_clearance_m.value_or(cell.clearance_m), cell.clearance_m);
  settings.checking = cell.checking;
  settings.scheduling = cell.scheduling;
  settings.monitor = cell.monitor;
  settings.execution = cell.execution;
  settings_part().write(out, settings);
}

}  // namespace

void write_object(JsonWriter& out, const CollisionObject& object) {
  ObjectDescription description{object.name, object.shape, object.X_WO};
  // Clients fetch meshes from the server: they are told the address, not the file.
  if (auto* mesh = std::get_if<Mesh>(&description.shape)) mesh->path = mesh_address(mesh->path);
  scene_object_format()->write(out, description);
}

void write_objects(JsonWriter& out, const std::vector<CollisionObject>& objects) {
  out.begin_array();
  for (const CollisionObject& object : objects) write_object(out, object);
  out.end_array();
}

std::string cell_json(const Cell& cell, std::string_view policy, double speed) {
  JsonWriter out;
  out.begin_object().field("name", cell.name).field("policy", policy).field("speed", speed);
  out.key("robots").begin_array();
  for (const Robot& robot : cell.robots) write_robot(out, cell, robot);
  out.end_array().key("objects");
  write_objects(out, cell.objects);
  out.key("joints").begin_array();
  for (const Joint& joint : cell.joints) write_joint(out, cell, joint);
  out.end_array();
  write_settings(out, cell);
  out.end_object();
  return out.take();
}

}  // namespace armloom
