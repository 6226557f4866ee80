#include "core/trajectory/implicit_start.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/trajectory/joint_line.h"
#include "core/trajectory/request_checks.h"

namespace armloom {
namespace {

std::vector<std::optional<JointId>> joints_of(const TrajectoryRequest& request, const Cell& cell) {
  std::vector<std::optional<JointId>> joints;
  for (const std::string& name : request.joint_names) {
    joints.push_back(find_joint(name, request.arm, cell));
  }
  return joints;
}

// Returns the arms of which the request names no joint but gripper joints.
std::vector<ArmId> arms_that_stay(const TrajectoryRequest& request, const Cell& cell) {
  std::vector<ArmId> arms = arms_of(request, cell);
  for (const auto& joint : joints_of(request, cell)) {
    if (!joint || !cell.joint(*joint).arm) continue;
    const ArmId arm = *cell.joint(*joint).arm;
    const std::vector<JointId>& own = cell.arm(arm).joints;
    if (std::ranges::find(own, *joint) != own.end()) std::erase(arms, arm);
  }
  return arms;
}

bool begins_before_first_waypoint(const TrajectoryRequest& request) {
  if (request.points.empty()) return false;
  const double first_s = request.points.front().time_from_start_s;
  if (request.points.size() == 1) return !(first_s < 0.0);
  const bool times_count = !request.retime || request.retime->only_if_needed;
  return times_count && first_s <= kDurationMax_s && from_seconds(first_s) > Duration::zero();
}

// A measured position may be beyond a limit by noise.
double within_limits(const Configuration& rest, JointId id, const Cell& cell) {
  const Joint& joint = cell.joint(id);
  return std::clamp(rest[static_cast<Eigen::Index>(id.index())], joint.lower, joint.upper);
}

void keep_in_place(ArmId arm, const Cell& cell, const Configuration& rest,
                   TrajectoryRequest& request) {
  for (const JointId joint : cell.arm(arm).joints) {
    request.joint_names.push_back(cell.joint(joint).name);
    for (WaypointRequest& point : request.points) {
      point.positions.push_back(within_limits(rest, joint, cell));
      if (!point.velocities.empty()) point.velocities.push_back(0.0);
      if (!point.accelerations.empty()) point.accelerations.push_back(0.0);
    }
  }
}

// Returns the position of each named joint at rest; nullopt if a joint is unknown.
std::optional<std::vector<double>> start_of(const TrajectoryRequest& request, const Cell& cell,
                                            const Configuration& rest) {
  std::vector<double> start;
  for (const auto& joint : joints_of(request, cell)) {
    if (!joint) return std::nullopt;
    start.push_back(within_limits(rest, *joint, cell));
  }
  return start;
}

bool is_at(const std::vector<double>& start, const std::vector<double>& position,
           double tolerance) {
  return std::ranges::equal(
      start, position, [tolerance](double a, double b) { return std::abs(a - b) <= tolerance; });
}

Problem no_time_to_get_there(const TrajectoryRequest& request, const std::vector<double>& start,
                             double tolerance) {
  const std::vector<double>& position = request.points.front().positions;
  std::size_t j = 0;
  while (std::abs(start[j] - position[j]) <= tolerance) ++j;
  return {ProblemKind::invalid, "no-time", "/points/0/time_from_start",
          "waypoint 0 is the only one and has no time above 0, but " + request.joint_names[j] +
              " will be at " + to_text(start[j]) + ", not at " + to_text(position[j]) +
              ": give the time in which the arm may get there" + kRetimeRemedy,
          0.0};
}

}  // namespace

bool has_implicit_start(const TrajectoryRequest& request, const Cell& cell) {
  if (request.points.size() > kImplicitStartWaypointsMax || request.has_implicit_start) {
    return false;
  }
  return begins_before_first_waypoint(request) || !arms_that_stay(request, cell).empty();
}

std::vector<ArmId> arms_of(const TrajectoryRequest& request, const Cell& cell) {
  std::vector<ArmId> arms;
  for (const auto& joint : joints_of(request, cell)) {
    if (!joint || !cell.joint(*joint).arm) continue;
    const ArmId arm = *cell.joint(*joint).arm;
    if (std::ranges::find(arms, arm) == arms.end()) arms.push_back(arm);
  }
  return arms;
}

Result<TrajectoryRequest> with_implicit_start(TrajectoryRequest request, const Cell& cell,
                                              const Configuration& rest) {
  for (const ArmId arm : arms_that_stay(request, cell)) keep_in_place(arm, cell, rest, request);
  const auto start = start_of(request, cell, rest);
  if (!start || !begins_before_first_waypoint(request)) return request;
  WaypointRequest& first = request.points.front();
  if (first.positions.size() != start->size()) return request;  // validate() reports this

  const double tolerance = cell.execution.start_tolerance_rad;
  const bool is_alone = request.points.size() == 1;
  const bool has_time = first.time_from_start_s > 0.0;
  const bool time_counts = has_time && (!request.retime || request.retime->only_if_needed);
  if (is_alone && !time_counts && is_at(*start, first.positions, tolerance)) {
    const std::vector<double> zeros(start->size(), 0.0);
    request.points = {{first.positions, zeros, {}, 0.0},
                      {first.positions, zeros, {}, to_seconds(kLineMin)}};
    request.retime.reset();
    request.has_implicit_start = true;
    return request;
  }
  if (is_alone && !has_time && !request.retime) {
    return failure(no_time_to_get_there(request, *start, tolerance));
  }
  WaypointRequest begin{.positions = *start, .time_from_start_s = 0.0};
  begin.velocities.assign(start->size(), 0.0);
  if (!first.accelerations.empty()) begin.accelerations = begin.velocities;
  request.points.insert(request.points.begin(), std::move(begin));
  request.has_implicit_start = true;
  return request;
}

Result<TrajectoryPtr> validate_from(const TrajectoryRequest& request, const Cell& cell,
                                    const Configuration& rest) {
  if (!has_implicit_start(request, cell)) return validate(request, cell);
  const auto complete = with_implicit_start(request, cell, rest);
  if (!complete) return failure(complete.error());
  return validate(*complete, cell);
}

}  // namespace armloom
