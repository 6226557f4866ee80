#include "core/trajectory/validate.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/trajectory/check_limits.h"

namespace armloom {
namespace {

std::string pointer_to(std::size_t k) { return "/points/" + std::to_string(k); }
std::string waypoint(std::size_t k) { return "waypoint " + std::to_string(k); }

struct Names {
  std::vector<JointId> joints;
  std::vector<ArmId> arms;  // ascending, each once
};

void check_complete(const Cell& cell, const std::vector<ArmId>& arms,
                    const std::set<JointId>& named, ProblemList& problems) {
  for (const ArmId arm : arms) {
    for (const JointId id : cell.arm(arm).joints) {
      if (named.contains(id)) continue;
      problems.add({ProblemKind::invalid, "missing-joint", "/joint_names",
                    "joint " + cell.joint(id).name + " of arm " + cell.arm(arm).name +
                        " is missing; a motion names every joint of each arm that it moves",
                    static_cast<double>(named.size())});
    }
  }
}

Names resolve_names(const TrajectoryRequest& request, const Cell& cell, ProblemList& problems) {
  Names names;
  if (request.joint_names.empty()) {
    problems.add(
        {ProblemKind::invalid, "empty-trajectory", "/joint_names", "joint_names is empty", 0.0});
  }
  std::set<JointId> named;
  std::set<ArmId> arms;
  for (std::size_t i = 0; i < request.joint_names.size() && !problems.full(); ++i) {
    const std::string& name = request.joint_names[i];
    const auto refuse = [&](const char* slug, const char* why) {
      problems.add({ProblemKind::invalid, slug, "/joint_names/" + std::to_string(i),
                    "joint " + name + " " + why, name});
    };
    const std::optional<JointId> id = cell.find_joint(name);
    if (!id) {
      refuse("unknown-joint", "is not a movable joint of the cell");
    } else if (!cell.joint(*id).arm) {
      refuse(
          "joint-of-no-arm",
          "is in no arm's group of the cell, so nothing can move it: list it in the group, or let "
          "the cell hold it (\"fixed\")");
    } else if (!named.insert(*id).second) {
      refuse("duplicate-joint", "is named twice");
    } else {
      names.joints.push_back(*id);
      arms.insert(*cell.joint(*id).arm);
    }
  }
  names.arms.assign(arms.begin(), arms.end());
  check_complete(cell, names.arms, named, problems);
  return names;
}

bool check_count(const TrajectoryRequest& request, ProblemList& problems) {
  const std::size_t count = request.points.size();
  if (count == 0) {
    problems.add({ProblemKind::invalid, "empty-trajectory", "/points", "points is empty", 0.0});
  } else if (count == 1) {
    problems.add({ProblemKind::invalid, "too-few-points", "/points",
                  "1 waypoint makes no motion; at least 2 are needed", 1.0});
  } else if (count > kWaypointsMax) {
    problems.add(
        {ProblemKind::too_large, "too-many-points", "/points",
         std::to_string(count) + " waypoints are more than " + std::to_string(kWaypointsMax),
         static_cast<double>(count)});
  } else {
    return true;
  }
  return false;
}

void check_numbers(std::size_t k, const char* member, const std::vector<double>& numbers,
                   const TrajectoryRequest& request, ProblemList& problems) {
  const std::size_t expected = request.joint_names.size();
  if (numbers.size() != expected) {
    problems.add({ProblemKind::invalid, "size-mismatch", pointer_to(k) + "/" + member,
                  waypoint(k) + ": " + std::to_string(numbers.size()) + " " + member + " for " +
                      std::to_string(expected) + " joints",
                  static_cast<double>(numbers.size())});
    return;
  }
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    if (std::isfinite(numbers[j])) continue;
    problems.add({ProblemKind::invalid, "not-finite",
                  pointer_to(k) + "/" + member + "/" + std::to_string(j),
                  waypoint(k) + ", " + request.joint_names[j] + ": " + to_text(numbers[j]) +
                      " in " + member + " is not a finite number",
                  to_text(numbers[j])});
  }
}

void check_members(const TrajectoryRequest& request, ProblemList& problems) {
  const std::vector<WaypointRequest>& points = request.points;
  const auto no_velocities = [](const WaypointRequest& p) { return p.velocities.empty(); };
  const auto no_accelerations = [](const WaypointRequest& p) { return p.accelerations.empty(); };
  const auto first_bare = std::find_if(points.begin(), points.end(), no_velocities);
  if (first_bare != points.end()) {
    const auto k = static_cast<std::size_t>(first_bare - points.begin());
    problems.add({ProblemKind::invalid,
                  "no-velocities",
                  pointer_to(k),
                  waypoint(k) + " has no velocities: without them the motion cannot start and "
                                "end at rest",
                  {}});
  }
  const auto first_without = std::find_if(points.begin(), points.end(), no_accelerations);
  if (first_without != points.end() &&
      !std::all_of(points.begin(), points.end(), no_accelerations)) {
    const auto k = static_cast<std::size_t>(first_without - points.begin());
    problems.add({ProblemKind::invalid,
                  "partial-accelerations",
                  pointer_to(k),
                  waypoint(k) + " has no accelerations but others have: give them in all "
                                "waypoints or in none",
                  {}});
  }
  for (std::size_t k = 0; k < points.size() && !problems.full(); ++k) {
    check_numbers(k, "positions", points[k].positions, request, problems);
    if (!points[k].velocities.empty()) {
      check_numbers(k, "velocities", points[k].velocities, request, problems);
    }
    if (!points[k].accelerations.empty()) {
      check_numbers(k, "accelerations", points[k].accelerations, request, problems);
    }
  }
}

// The time of waypoint k; nothing, and a problem, if it can be no time at all.
std::optional<Duration> read_time(std::size_t k, double time_s, ProblemList& problems) {
  const std::string pointer = pointer_to(k) + "/time_from_start";
  const std::string found = waypoint(k) + ": time " + to_text(time_s) + " s ";
  if (!std::isfinite(time_s)) {
    problems.add({ProblemKind::invalid, "not-finite", pointer, found + "is not a finite number",
                  to_text(time_s)});
  } else if (time_s > kDurationMax_s) {
    problems.add({ProblemKind::invalid, "too-long", pointer,
                  found + "exceeds " + to_text(kDurationMax_s), time_s});
  } else if (time_s <= -1.0 || from_seconds(time_s) < Duration::zero()) {
    problems.add({ProblemKind::invalid, "negative-time", pointer, found + "is negative", time_s});
  } else {
    return from_seconds(time_s);
  }
  return std::nullopt;
}

std::vector<Duration> read_times(const TrajectoryRequest& request, ProblemList& problems) {
  std::vector<Duration> times;
  times.reserve(request.points.size());
  std::optional<Duration> before;
  for (std::size_t k = 0; k < request.points.size() && !problems.full(); ++k) {
    const double time_s = request.points[k].time_from_start_s;
    const std::optional<Duration> time = read_time(k, time_s, problems);
    if (time && k == 0 && *time != Duration::zero()) {
      problems.add({ProblemKind::invalid, "first-time-not-zero", "/points/0/time_from_start",
                    "waypoint 0: time " + to_text(time_s) + " s, but a motion begins at 0",
                    time_s});
    }
    if (time && before && *time - *before < from_seconds(kSegmentMin_s)) {
      problems.add({ProblemKind::invalid, "time-not-increasing", pointer_to(k) + "/time_from_start",
                    waypoint(k) + ": time " + to_text(time_s) + " s is " +
                        to_text(to_seconds(*time - *before)) + " s after waypoint " +
                        std::to_string(k - 1) + "; at least " + to_text(kSegmentMin_s) +
                        " s is needed",
                    time_s});
    }
    if (time) times.push_back(*time);
    before = time;
  }
  return times;
}

}  // namespace

Result<TrajectoryPtr> validate(const TrajectoryRequest& request, const Cell& cell) {
  ProblemList problems;
  Names names = resolve_names(request, cell, problems);
  std::vector<Duration> times;
  if (check_count(request, problems)) {
    check_members(request, problems);
    times = read_times(request, problems);
  }
  if (!problems.empty()) return failure(std::move(problems).take());

  std::vector<Segment> segments = checked_segments(request, times, names.joints, cell, problems);
  if (!problems.empty()) return failure(std::move(problems).take());
  return std::make_shared<const Trajectory>(std::move(names.joints), std::move(names.arms),
                                            std::move(segments));
}

}  // namespace armloom
