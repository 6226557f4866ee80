#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "core/audit/audit.h"
#include "core/base/diagnostics.h"
#include "core/executive/promise_report.h"
#include "core/executive/shape_report.h"
#include "server/codec/cell_format.h"
#include "server/command/command.h"
#include "server/messages/cell.h"

namespace armloom {
namespace {

double no_minus_zero(double number) { return number == 0.0 ? 0.0 : number; }

std::string listed(const Eigen::VectorXd& q) {
  std::ostringstream text;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    text << (i > 0 ? ", " : "") << no_minus_zero(q[i]);
  }
  return text.str();
}

std::string counted_shapes(const Cell& cell, const std::vector<LinkId>& links) {
  static constexpr const char* kNames[] = {"box", "cylinder", "sphere", "mesh"};
  std::map<std::string, int> counts;
  for (const LinkId id : links) {
    for (const PlacedShape& shape : cell.link(id).shapes) ++counts[kNames[shape.shape.index()]];
  }
  std::string text;
  for (const auto& [name, count] : counts) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  return text.empty() ? "none" : text;
}

// `marked`: the limit is a default.
void print_limit(double limit, bool marked = false) {
  std::cout << std::setw(9) << no_minus_zero(limit) << (marked ? '*' : ' ');
}

void print_joint(const Joint& joint) {
  std::cout << "    " << std::left << std::setw(30) << joint.name << std::right;
  print_limit(joint.lower);
  print_limit(joint.upper);
  print_limit(joint.velocity_max, joint.assumed.velocity);
  print_limit(joint.acceleration_max, joint.assumed.acceleration);
  print_limit(joint.jerk_max, joint.assumed.jerk);
  print_limit(joint.brake, joint.assumed.brake);
  std::cout << " " << joint.unit() << '\n';
}

void print_arm(const Cell& cell, const Arm& arm) {
  const auto print = [&](JointId id) { print_joint(cell.joint(id)); };
  std::cout << "  arm " << arm.name << " (group " << arm.group << "), " << arm.joints.size()
            << " joints, " << arm.links.size()
            << " links, shapes: " << counted_shapes(cell, arm.links) << '\n';
  std::cout << "    home " << listed(arm.home) << '\n';
  if (!arm.gripper_joints.empty()) {
    std::cout << "    gripper starts at";
    for (const JointId id : arm.gripper_joints)
      std::cout << (id == arm.gripper_joints.front() ? " " : ", ")
                << no_minus_zero(cell.joint(id).start) << " (" << cell.joint(id).name << ')';
    std::cout << '\n';
  }
  if (arm.payload) {
    std::cout << "    holds at most " << arm.payload->max_kg << " kg, and then keeps "
              << 100.0 * arm.payload->brake_at_max << " % of its brake\n";
  }
  std::cout << "    " << std::left << std::setw(30) << "joint" << std::right;
  for (const char* limit : {"lower", "upper", "velocity", "accel.", "jerk", "brake"}) {
    std::cout << std::setw(9) << limit << ' ';
  }
  std::cout << '\n';
  std::for_each(arm.joints.begin(), arm.joints.end(), print);
  std::for_each(arm.gripper_joints.begin(), arm.gripper_joints.end(), print);
}

void print_signal(const SignalDescription& signal) {
  std::cout << "  " << to_string(signal.direction) << ' ' << signal.name << " ("
            << to_string(signal.value_type()) << ")";
  if (!signal.place) {
    const auto& first = signal.initial;
    const char* zero = signal.value_type() == SignalType::boolean ? "false" : "0";
    std::cout << ": " << (first ? text_of(*first) : zero) << " at the start\n";
    return;
  }
  std::cout << ": " << to_string(signal.place->table) << ' ' << signal.place->address;
  if (signal.fail_state) {
    std::cout << ", fail state " << text_of(*signal.fail_state);
  } else if (signal.direction == SignalDirection::output) {
    std::cout << ", no fail state: the server never writes it by itself";
  }
  std::cout << '\n';
}

void print_io(const IoDescription& io) {
  for (const IoDeviceDescription& device : io.devices) {
    std::cout << "I/O device " << device.name << ": Modbus at " << device.endpoint << ", unit "
              << device.unit << ", read every " << to_seconds(device.poll_period)
              << " s, lost after " << to_seconds(device.timeout) << " s without an answer\n";
    for (const SignalDescription& signal : io.signals) {
      if (signal.place && signal.place->device == device.name) print_signal(signal);
    }
  }
  const auto is_simulated = [](const SignalDescription& signal) { return !signal.place; };
  if (std::ranges::any_of(io.signals, is_simulated)) std::cout << "simulated signals\n";
  for (const SignalDescription& signal : io.signals) {
    if (is_simulated(signal)) print_signal(signal);
  }
}

void print_cell(const Cell& cell) {
  std::cout << std::setprecision(6) << "cell " << cell.name << ": " << cell.robots.size()
            << " robots, " << cell.arms.size() << " arms, " << cell.joints.size() << " joints, "
            << cell.links.size() << " links, " << cell.objects.size() << " objects\n";
  for (const Robot& robot : cell.robots) {
    const Eigen::Vector3d& p = robot.X_WB.translation();
    std::cout << "robot " << robot.name << " (prefix \"" << robot.prefix << "\") at "
              << no_minus_zero(p.x()) << ", " << no_minus_zero(p.y()) << ", "
              << no_minus_zero(p.z()) << "; controller " << robot.controller.type
              << (robot.controller.endpoint.empty() ? "" : " at ") << robot.controller.endpoint
              << (robot.controller.type == "remote" ? "; when simulated: lag " : ", lag ")
              << to_seconds(robot.controller.lag) << " s, noise " << robot.controller.noise_rad
              << " rad\n";
    for (const ArmId arm : robot.arms) print_arm(cell, cell.arm(arm));
  }
  std::cout << "  * a default: velocity " << kDefaultVelocity << ", acceleration "
            << kDefaultAcceleration << ", jerk " << kDefaultJerk
            << ", brake twice the acceleration\n";
  static constexpr const char* kNames[] = {"box", "cylinder", "sphere", "mesh"};
  for (const CollisionObject& object : cell.objects) {
    const Eigen::Vector3d& p = object.X_WO.translation();
    std::cout << "object " << object.name << ": " << kNames[object.shape.index()] << " at "
              << no_minus_zero(p.x()) << ", " << no_minus_zero(p.y()) << ", "
              << no_minus_zero(p.z());
    if (const double kg = object.mass.kg; kg > 0.0) {
      const auto holds = [kg](const Arm& arm) { return arm.payload && arm.payload->max_kg >= kg; };
      std::cout << ", " << kg << " kg"
                << (std::ranges::any_of(cell.arms, holds) ? "" : ": no arm may hold it (payload)");
    }
    std::cout << '\n';
  }
  print_io(cell.io);
  std::cout << settings_text(settings_of(cell));
}

void print_shapes(const std::vector<ShapeReport>& report) {
  std::cout << std::left << std::setw(34) << "link or object" << std::right << std::setw(14)
            << "convex shapes" << std::setw(10) << "capsules" << std::setw(24) << "capsule excess"
            << '\n';
  for (const ShapeReport& body : report) {
    std::ostringstream millimeters;
    millimeters << std::fixed << std::setprecision(1) << 1000.0 * body.excess_m << " mm";
    std::cout << std::left << std::setw(34) << body.body << std::right << std::setw(14)
              << body.convex_shapes << std::setw(10) << body.capsules << std::setw(24)
              << millimeters.str() << '\n';
  }
}

std::string millimeters(const PromiseReport::Distance& distance) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << 1000.0 * distance.home_m << " mm (at home; at most "
       << 1000.0 * distance.max_m << " mm)";
  return text.str();
}

void print_promises(const Cell& cell, const PromiseReport& report) {
  const Arm& arm = cell.arm(report.arm);
  const ControllerDescription& promised = cell.robots[arm.robot.index()].controller;
  std::cout << "promises of arm " << arm.name << " (smaller is better):\n"
            << "  tracking error " << report.tracking_error << " rad (m): adds "
            << millimeters(report.inflation) << " of clearance around the arm\n"
            << "  reaction " << to_seconds(promised.reaction)
            << " s: if one joint moves at full speed, the arm's farthest point moves "
            << millimeters(report.reaction)
            << " before the arm brakes; with braking, it stops after "
            << std::round(1e3 * report.stopping_s) / 1e3 << " s and "
            << millimeters(report.stopping) << '\n'
            << "  feedback every " << to_seconds(promised.feedback_period) << " s, lost after "
            << to_seconds(promised.feedback_timeout) << " s: the authority reaches "
            << to_seconds(report.horizon)
            << " s (at planned speed) beyond the stopping point; in a motion of several arms, one "
               "arm may be ahead by "
            << to_seconds(report.lead) << " s\n";
}

// A home whose clearance is not certified is no fault: the arm may leave it if the pair moves
// apart.
void warn_of_home(const std::string& cell_file, const Cell& cell, const PromiseReport& report) {
  if (!report.too_close_at_home) return;
  const Proximity& near = *report.too_close_at_home;
  std::cerr
      << cell_file << ": warning: arm " << cell.arm(report.arm).name << " at home: " << near.body_a
      << " and " << near.body_b << " are " << near.clearance_m
      << " m apart, but their required clearance of " << near.limit_m
      << " m is not certified if joints deviate by tracking_error_rad, so jobs may be refused "
         "there; change the home, or lower the controller's tracking_error_rad\n";
}

}  // namespace

int validate_cell(const std::string& cell_file, bool verbose) {
  const Detail detail = verbose ? Detail::all : Detail::one_of_each_kind;
  const auto loaded = load_cell(cell_file, detail);
  if (!loaded) return kExitBadInput;
  const Cell& cell = *loaded->cell;
  print_cell(cell);
  if (!is_fit_to_run(*loaded, detail)) return kExitBadInput;

  const auto shapes = report_shapes(loaded->cell);
  if (!shapes) {
    complain(cell_file, shapes.error());
    return kExitBadInput;
  }
  const auto report =
      audit(cell, {RecordedState{TimePoint{}, cell.home()}}, std::chrono::milliseconds(1));
  if (!report) {
    complain(cell_file, report.error());
    return kExitBadInput;
  }
  print_shapes(*shapes);
  const auto promises = report_promises(loaded->cell);
  if (!promises) {
    complain(cell_file, promises.error());
    return kExitBadInput;
  }
  for (const PromiseReport& promised : *promises) {
    print_promises(cell, promised);
    warn_of_home(cell_file, cell, promised);
  }
  if (const auto& smallest = report->smallest_clearance) {
    std::cout << "home clearance " << smallest->distance_m << " m: " << smallest->body_a << " and "
              << smallest->body_b << '\n';
  }
  std::cout << "no fault found" << std::endl;
  return kExitDone;
}

}  // namespace armloom
