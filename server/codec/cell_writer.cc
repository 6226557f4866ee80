#include <Eigen/Geometry>
#include <cmath>

#include "server/codec/cell_codec.h"
#include "server/codec/mesh_address.h"

namespace armloom {
namespace {

void write_vector(JsonWriter& out, const Eigen::VectorXd& numbers) {
  out.begin_array();
  for (const double number : numbers) out.value(number);
  out.end_array();
}

// Fixed-axis roll, pitch, yaw as URDF has them. At pitch = ±90° yaw is taken as zero.
Eigen::Vector3d rpy_of(const Eigen::Matrix3d& R) {
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cos_pitch);
  if (cos_pitch < 1e-9) return {std::atan2(-R(1, 2), R(1, 1)), pitch, 0.0};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

void write_pose(JsonWriter& out, const Eigen::Isometry3d& X) {
  out.key("xyz");
  write_vector(out, X.translation());
  out.key("rpy");
  write_vector(out, rpy_of(X.linear()));
}

struct ShapeWriter {
  JsonWriter& out;
  void operator()(const Box& box) const {
    out.key("box");
    write_vector(out, box.size_m);
  }
  void operator()(const Cylinder& cylinder) const {
    out.key("cylinder").begin_array().value(cylinder.radius_m).value(cylinder.length_m).end_array();
  }
  void operator()(const Sphere& sphere) const {
    out.key("sphere").begin_array().value(sphere.radius_m).end_array();
  }
  void operator()(const Mesh& mesh) const {
    out.field("mesh", mesh_address(mesh.path));
    out.key("scale");
    write_vector(out, mesh.scale);
  }
};

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
  out.field("clearance_m", cell.clearance_m);
  out.field("self_clearance_m", cell.self_clearance_m);
  out.key("checking").begin_object();
  out.field("time_step_s", cell.checking.time_step);
  out.field("tracking_error_rad", cell.checking.tracking_error_rad);
  out.field("delay_s", cell.checking.delay);
  out.field("limit_tolerance", cell.checking.limit_tolerance).end_object();
  out.key("scheduling").begin_object();
  out.field("policy", cell.scheduling.policy);
  out.field("backlog_timeout_s", cell.scheduling.backlog_timeout);
  out.field("aging_s", cell.scheduling.aging);
  out.field("on_idle_blocker", cell.scheduling.on_idle_blocker).end_object();
  out.key("monitor").begin_object();
  out.field("rate_hz", cell.monitor.rate_hz);
  out.field("reaction_s", cell.monitor.reaction);
  out.field("stop_clearance_m", cell.monitor.stop_clearance_m).end_object();
  out.key("execution").begin_object();
  out.field("start_tolerance_rad", cell.execution.start_tolerance_rad);
  out.field("duration_scaling", cell.execution.duration_scaling);
  out.field("duration_margin_s", cell.execution.duration_margin).end_object();
}

}  // namespace

void write_object(JsonWriter& out, const CollisionObject& object) {
  out.begin_object().field("name", object.name);
  std::visit(ShapeWriter{out}, object.shape);
  write_pose(out, object.X_WO);
  out.end_object();
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
