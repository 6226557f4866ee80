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
// Mimic joints are not included: they follow another joint.
using Configuration = Eigen::VectorXd;

enum class JointKind { revolute, continuous, prismatic };

// Bound on every joint position (rad or m), also for joints without limits. It exceeds any useful
// position, but is small enough to avoid overflow and loss of precision.
inline constexpr double kFarthestPosition = 1e5;

// A movable joint that is not a mimic: one entry of a Configuration.
struct Joint {
  std::string name;  // with prefix
  RobotId robot;
  std::optional<ArmId> arm;  // arm that has it as a joint or gripper joint
  JointKind kind;
  double lower;  // rad or m; -kFarthestPosition if a continuous joint has no limit
  double upper;
  double velocity_max;      // > 0; rad/s or m/s
  double acceleration_max;  // > 0
  double jerk_max;          // > 0
  double brake;             // > 0; deceleration of stops
  // Start position of a joint that is in no arm's group. It is the position nearest to 0 within the
  // limits, unless the cell file's "gripper" sets it.
  double start = 0.0;

  [[nodiscard]] bool has_lower() const { return lower > -kFarthestPosition; }
  [[nodiscard]] bool has_upper() const { return upper < kFarthestPosition; }
  // For messages.
  [[nodiscard]] std::string unit() const { return kind == JointKind::prismatic ? "m" : "rad"; }

  // True for each limit that no file gives, so that its default applies.
  struct Assumed {
    bool velocity = false;
    bool acceleration = true;
    bool jerk = true;
    bool brake = true;
  } assumed = {};
};

// A link, together with the joint that connects it to its parent link P. Its pose in the world W is
//   X_WL = X_WP * X_PJ * motion(axis, multiplier * q[driver] + offset)
// where J is the joint frame. A root link has no parent: its X_PJ is the robot's base pose X_WB.
struct Link {
  std::string name;  // with prefix
  RobotId robot;
  std::optional<ArmId> arm;      // arm that moves it, the nearest if several; nullopt if static
  std::optional<LinkId> parent;  // smaller than the link's own id
  Eigen::Isometry3d X_PJ = Eigen::Isometry3d::Identity();
  std::optional<JointId> driver;  // nullopt if fixed
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
  std::vector<JointId> joints;                          // from base to tip
  std::vector<JointId> gripper_joints;                  // movable, below the arm, in no arm's group
  std::vector<LinkId> links;                            // moved by these joints
  Eigen::VectorXd home;                                 // size joints.size()
  std::map<std::string, Eigen::VectorXd> named_states;  // from the SRDF
  // States of the SRDF that give positions of gripper joints only ("open").
  std::map<std::string, std::map<JointId, double>> gripper_states = {};
  std::optional<PayloadDescription> payload = {};
};

struct Robot {
  std::string name;
  std::string prefix;
  std::string srdf_prefix = {};  // which the URDF's names have before those of the SRDF
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  std::vector<ArmId> arms;
  std::string urdf_text;  // for the dashboard; as read, but joints named in "fixed" are fixed
  std::string srdf_text;
  ControllerDescription controller;
  // Paths of existing mesh files, also of visuals, by their name in the URDF (package://...).
  std::map<std::string, std::string> mesh_files;
  // By prefixed joint name: the reason why a joint has no value of its own ("follows left_finger").
  std::map<std::string, std::string> joints_without_value;
};

struct CollisionObject {
  std::string name;
  Shape shape;
  Eigen::Isometry3d X_WO = Eigen::Isometry3d::Identity();
  Mass mass = {};
};

// A pair of links, the smaller id first.
using LinkPair = std::pair<LinkId, LinkId>;

// Pairs of bodies that are not checked, and pairs that an SRDF disables without proof.
struct AllowedCollisions {
  // From the robots' files: pairs within one rigid body, and pairs that an SRDF disables, except
  // claimed_pairs.
  std::set<LinkPair> link_pairs;
  // From the cell file.
  std::set<LinkPair> cell_file_pairs;
  std::set<std::pair<LinkId, std::string>> link_objects;  // link, object name
  // Pairs that an SRDF disables between different arms, or between an arm and a static link other
  // than its mount. The value is the place in the SRDF ("arm.srdf:17"). MoveIt's Setup Assistant
  // disables pairs that did not meet in random samples, which does not prove that they cannot meet.
  // So these pairs are checked, unless they are proven out of reach
  // (core/collision/scene/out_of_reach.h) or are in cell_file_pairs.
  std::map<LinkPair, std::string> claimed_pairs;

  // Returns true if links a and b, in either order, may touch. Ignores claimed_pairs.
  [[nodiscard]] bool allows(LinkId a, LinkId b) const {
    const LinkPair pair = std::minmax(a, b);
    return link_pairs.contains(pair) || cell_file_pairs.contains(pair);
  }
};
// Minimum distances between bodies that may not touch.
struct Clearances {
  double clearance_m = 0.02;
  double self_clearance_m = 0.005;          // for Cell::is_own() pairs; at most clearance_m
  std::optional<double> mount_clearance_m;  // between an arm and its mount; clearance_m if nullopt
  // Returns the clearance between an arm and its mount; at most clearance_m.
  [[nodiscard]] double mount_limit_m() const {
    const double limit_m = mount_clearance_m.value_or(clearance_m);
    return limit_m < clearance_m ? limit_m : clearance_m;
  }
};

// The robots, arms, joints and links of a cell and its settings. Immutable, shared by all threads.
// Built and checked by build_cell (core/model/cell/build_cell.h).
struct Cell {
  std::string name;
  std::vector<Robot> robots;             // indexed by RobotId
  std::vector<Arm> arms;                 // indexed by ArmId
  std::vector<Joint> joints;             // indexed by JointId
  std::vector<Link> links;               // indexed by LinkId; parents before children
  std::vector<CollisionObject> objects;  // the scene at start

  AllowedCollisions allowed;
  Clearances clearances;
  CheckingSettings checking;
  SchedulingSettings scheduling;
  MonitorSettings monitor;
  ExecutionSettings execution;
  IoDescription io;

  [[nodiscard]] const Arm& arm(ArmId id) const { return arms[id.index()]; }
  [[nodiscard]] const Joint& joint(JointId id) const { return joints[id.index()]; }
  [[nodiscard]] const Link& link(LinkId id) const { return links[id.index()]; }
  // Returns how far a joint of the robot may be from its path (rad, m): the promise of the robot's
  // controller or, without one, checking.tracking_error_rad.
  [[nodiscard]] double tracking_error(RobotId robot) const {
    return robots[robot.index()].controller.tracking_error_rad.value_or(
        checking.tracking_error_rad);
  }
  [[nodiscard]] std::optional<ArmId> find_arm(std::string_view arm_name) const;
  [[nodiscard]] std::optional<JointId> find_joint(std::string_view joint_name) const;
  [[nodiscard]] std::optional<LinkId> find_link(std::string_view link_name) const;

  // Returns true if the link is static and carries the arm, directly or through fixed links without
  // shapes. Such a mount may be a pedestal or a table in the same URDF. Every link of the arm keeps
  // mount_clearance_m from the mount. A value below clearance_m suits robots that fold onto their
  // own body. A link that touches the mount is allowed if the SRDF disables the pair or, without an
  // SRDF, if a joint connects them.
  [[nodiscard]] bool is_mount(LinkId link, ArmId arm) const;
  // Returns true if both links belong to one arm. Such links pass each other closely by design, so
  // they keep only self_clearance_m.
  [[nodiscard]] bool is_own(LinkId a, LinkId b) const;

  // Returns the configuration with every arm at its home and all other joints at Joint::start.
  [[nodiscard]] Configuration home() const;
};

using CellPtr = std::shared_ptr<const Cell>;

}  // namespace armloom
