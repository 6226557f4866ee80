#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/base/problem.h"
#include "core/geometry/shape.h"
#include "core/model/cell_description.h"

namespace armloom {

// Positions of all movable joints of the cell, indexed by JointId; rad, or m for prismatic joints.
// Mimic joints are not in it: they follow.
using Configuration = Eigen::VectorXd;

enum class JointKind { revolute, continuous, prismatic };

// How far any joint may be from zero (rad or m), also one without limits: beyond any use, and near
// enough that nothing that is made of it overflows or loses more than its last digits.
inline constexpr double kFarthestPosition = 1e5;

// A movable joint that is no mimic: one entry of a Configuration.
struct Joint {
  std::string name;  // with prefix
  RobotId robot;
  std::optional<ArmId> arm;  // the arm that it belongs to, as arm or gripper joint
  JointKind kind;
  double lower;  // rad or m; where no file says so, of continuous joints, -kFarthestPosition
  double upper;
  double velocity_max;      // > 0; rad/s or m/s
  double acceleration_max;  // > 0
  double jerk_max;          // > 0
  double brake;             // > 0: deceleration that a stop may use
  // Where it stands at the start, if it is no joint of an arm's group: at zero, or at the limit
  // next to it, unless the cell says more of a gripper's.
  double start = 0.0;

  [[nodiscard]] bool has_lower() const { return lower > -kFarthestPosition; }
  [[nodiscard]] bool has_upper() const { return upper < kFarthestPosition; }
  // Of its positions, as people are told.
  [[nodiscard]] std::string unit() const { return kind == JointKind::prismatic ? "m" : "rad"; }

  // Limits that no file gives: the defaults that cell_description.h states.
  struct Assumed {
    bool velocity = false;
    bool acceleration = true;
    bool jerk = true;
    bool brake = true;
  } assumed = {};
};

// A link, with the joint above it folded in:
//   X_WL = X_WP * X_PJ * motion(axis, multiplier * q[driver] + offset)
// where P is the parent link (for a root: the robot's base pose X_WB, which then stands in X_PJ).
struct Link {
  std::string name;  // with prefix
  RobotId robot;
  std::optional<ArmId> arm;      // the arm whose joints move it (nearest above); none: static
  std::optional<LinkId> parent;  // smaller than the link's own id: one pass computes all poses
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  std::optional<JointId> driver;  // none: fixed
  JointKind motion = JointKind::revolute;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit, in the joint frame J
  double multiplier = 1.0;                          // of a mimic joint
  double offset = 0.0;
  std::vector<PlacedShape> shapes;  // in the link frame L
};

struct Arm {
  std::string name;
  RobotId robot;
  std::string group;
  std::vector<JointId> joints;          // of the group, from base to tip
  std::vector<JointId> gripper_joints;  // movable joints below the arm that are in no arm's group
  std::vector<LinkId> links;            // every link that these joints move
  Eigen::VectorXd home;                 // size joints.size()
  std::map<std::string, Eigen::VectorXd> named_states;  // of the group, from the SRDF
};

struct Robot {
  std::string name;
  std::string prefix;
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  std::vector<ArmId> arms;
  std::string urdf_text;  // for the dashboard: as read, joints that the cell holds being fixed
  std::string srdf_text;
  ControllerDescription controller;
  // Meshes as the URDF names them (package://..., of visuals too) and their files, where they
  // exist.
  std::map<std::string, std::string> mesh_files;
  // Joints that have no value of their own, by their names with prefix: why not, as "follows
  // left_finger" says it.
  std::map<std::string, std::string> joints_without_value;
};

struct CollisionObject {
  std::string name;
  Shape shape;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
};

// A pair of links, the smaller id first.
using LinkPair = std::pair<LinkId, LinkId>;

// Pairs that need no check, and pairs of which an SRDF only claims it.
struct AllowedCollisions {
  // Named by the robot's files: links of one rigid body, and pairs of the SRDF within one arm or of
  // an arm and its mount.
  std::set<LinkPair> link_pairs;
  // Named by the cell file.
  std::set<LinkPair> cell_file_pairs;
  std::set<std::pair<LinkId, std::string>> link_objects;  // link, object name
  // Disabled by an SRDF, and links of different arms, or of an arm and what stands beside its
  // mount; with the place there ("arm.srdf:17"). MoveIt's Setup Assistant disables what did not
  // meet in random samples, which proves nothing: such a pair is checked unless it is proven to be
  // out of reach (core/collision/scene/out_of_reach.h) or in cell_file_pairs.
  std::map<LinkPair, std::string> claimed_pairs;

  // Returns true if the pair, in either order, may touch. Claims do not count.
  [[nodiscard]] bool allows(LinkId a, LinkId b) const {
    const LinkPair pair = std::minmax(a, b);
    return link_pairs.contains(pair) || cell_file_pairs.contains(pair);
  }
};
// What is kept from what may not be touched.
struct Clearances {
  double clearance_m = 0.02;
  double self_clearance_m = 0.005;          // of what Cell::is_own(); at most clearance_m
  std::optional<double> mount_clearance_m;  // of an arm from its mount; absent: clearance_m
  // What an arm keeps from its mount: never more than from the scene.
  [[nodiscard]] double mount_limit_m() const {
    const double limit_m = mount_clearance_m.value_or(clearance_m);
    return limit_m < clearance_m ? limit_m : clearance_m;
  }
};

// The robots, arms, joints and links of a cell and its settings: immutable, shared by all threads.
// Built by build_cell (core/model/cell/build_cell.h), which checks everything first.
struct Cell {
  std::string name;
  std::vector<Robot> robots;             // RobotId
  std::vector<Arm> arms;                 // ArmId
  std::vector<Joint> joints;             // JointId
  std::vector<Link> links;               // LinkId; parents before children
  std::vector<CollisionObject> objects;  // the scene at start

  AllowedCollisions allowed;
  Clearances clearances;
  CheckingSettings checking;
  SchedulingSettings scheduling;
  MonitorSettings monitor;
  ExecutionSettings execution;

  [[nodiscard]] const Arm& arm(ArmId id) const { return arms[id.index()]; }
  [[nodiscard]] const Joint& joint(JointId id) const { return joints[id.index()]; }
  [[nodiscard]] const Link& link(LinkId id) const { return links[id.index()]; }
  [[nodiscard]] std::optional<ArmId> find_arm(std::string_view arm_name) const;
  [[nodiscard]] std::optional<JointId> find_joint(std::string_view joint_name) const;
  [[nodiscard]] std::optional<LinkId> find_link(std::string_view link_name) const;

  // A link that stands still and carries a link that the arm moves: what the arm is mounted on. It
  // may be the arm's own pedestal, or a table that the URDF makes its base: no file tells them
  // apart. So it is scene, and all of the arm owes it mount_clearance_m: clearance_m unless the
  // cell says otherwise, as it may for robots that fold on their own body. (Neighbours that touch
  // are disabled by the SRDF, or by being parent and child where there is none.)
  // Links without a shape (mounting frames) hand that down to what they are fixed to.
  [[nodiscard]] bool is_mount(LinkId link, ArmId arm) const;
  // Two links of one arm: they pass each other closely by design and keep self_clearance_m.
  [[nodiscard]] bool is_own(LinkId a, LinkId b) const;

  // Every arm at its home; joints of no arm and gripper joints at zero, clamped to their limits.
  [[nodiscard]] Configuration home() const;
};

using CellPtr = std::shared_ptr<const Cell>;

}  // namespace armloom
