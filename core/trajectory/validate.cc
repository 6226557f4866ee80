#include "core/trajectory/validate.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/trajectory/check_limits.h"
#include "core/trajectory/request_checks.h"
#include "core/trajectory/timing/retime.h"

namespace armloom {
namespace {

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

// Returns the time of waypoint k, or nullopt with a problem.
std::optional<Duration> read_time(std::size_t k, double time_s, ProblemList& problems) {
  if (time_s >= 0.0 && time_s <= kDurationMax_s) return from_seconds(time_s);
  const std::string pointer = pointer_to(k) + "/time_from_start";
  const std::string found = waypoint(k) + ": time " + to_text(time_s) + " s ";
  if (std::isnan(time_s)) {
    problems.add({ProblemKind::invalid,
                  "no-time",
                  pointer_to(k),
                  waypoint(k) + " has no time_from_start: give one, or let the server make times "
                                "(\"retime\": true in the job)",
                  {}});
  } else if (!std::isfinite(time_s)) {
    problems.add({ProblemKind::invalid, "not-finite", pointer, found + "is not a finite number",
                  to_text(time_s)});
  } else if (time_s > kDurationMax_s) {
    problems.add({ProblemKind::invalid, "too-long", pointer,
                  found + "exceeds " + to_text(kDurationMax_s), time_s});
  } else if (time_s <= -1.0 || from_seconds(time_s) < Duration::zero()) {
    problems.add({ProblemKind::invalid, "negative-time", pointer, found + "is negative", time_s});
  } else {
    return Duration::zero();  // less than a nanosecond below
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
  if (request.retime) return retimed(request, cell);
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
