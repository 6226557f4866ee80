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
                  pointer_to(request, k),
                  waypoint(request, k) +
                      " has no velocities: without them the motion cannot start and "
                      "end at rest. Give velocities, 0 at both ends" +
                      kRetimeRemedy,
                  {}});
  }
  const auto first_without = std::find_if(points.begin(), points.end(), no_accelerations);
  if (first_without != points.end() &&
      !std::all_of(points.begin(), points.end(), no_accelerations)) {
    const auto k = static_cast<std::size_t>(first_without - points.begin());
    problems.add({ProblemKind::invalid,
                  "partial-accelerations",
                  pointer_to(request, k),
                  waypoint(request, k) + " has no accelerations but others have: give them in all "
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

// Returns the time of waypoint k, or adds a problem and returns nullopt.
std::optional<Duration> read_time(const TrajectoryRequest& request, std::size_t k,
                                  ProblemList& problems) {
  const double time_s = request.points[k].time_from_start_s;
  if (time_s >= 0.0 && time_s <= kDurationMax_s) return from_seconds(time_s);
  const std::string pointer = pointer_to(request, k) + "/time_from_start";
  const std::string found = waypoint(request, k) + ": time " + to_text(time_s) + " s ";
  if (std::isnan(time_s)) {
    problems.add({ProblemKind::invalid,
                  "no-time",
                  pointer_to(request, k),
                  waypoint(request, k) + " has no time_from_start: give one" + kRetimeRemedy,
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
    return Duration::zero();  // negative by less than a nanosecond
  }
  return std::nullopt;
}

std::vector<Duration> read_times(const TrajectoryRequest& request, ProblemList& problems) {
  std::vector<Duration> times;
  times.reserve(request.points.size());
  std::optional<Duration> before;
  for (std::size_t k = 0; k < request.points.size() && !problems.full(); ++k) {
    const double time_s = request.points[k].time_from_start_s;
    const std::optional<Duration> time = read_time(request, k, problems);
    if (time && k == 0 && *time != Duration::zero()) {
      problems.add({ProblemKind::invalid, "first-time-not-zero", "/points/0/time_from_start",
                    "waypoint 0: time " + to_text(time_s) +
                        " s, but a motion begins at 0: insert the position where the arm will be, "
                        "with time 0, or subtract " +
                        to_text(time_s) + " s from all times" + kRetimeRemedy,
                    time_s});
    }
    if (time && before && *time - *before < from_seconds(kSegmentMin_s)) {
      problems.add({ProblemKind::invalid, "time-not-increasing",
                    pointer_to(request, k) + "/time_from_start",
                    waypoint(request, k) + ": time " + to_text(time_s) + " s is " +
                        to_text(to_seconds(*time - *before)) + " s after " +
                        waypoint(request, k - 1) + "; at least " + to_text(kSegmentMin_s) +
                        " s is needed: remove one of the two" + kRetimeRemedy,
                    time_s});
    }
    if (time) times.push_back(*time);
    before = time;
  }
  return times;
}

// Returns true if waypoint k only repeats the state of the waypoint before it, up to rounding.
bool is_repeat(const std::vector<WaypointRequest>& points, std::size_t k) {
  const WaypointRequest &a = points[k - 1], &b = points[k];
  const double later_s = b.time_from_start_s - a.time_from_start_s;
  const auto within = [](double most) {
    return [most](double x, double y) { return std::abs(x - y) <= most; };
  };
  return later_s >= 0.0 && later_s < kRepeat_s &&
         std::ranges::equal(a.positions, b.positions, within(kPositionTolerance)) &&
         std::ranges::equal(a.velocities, b.velocities, within(kRestVelocity));
}

// Returns the request without repeated waypoints, or nullopt if no waypoint repeats its
// predecessor.
std::optional<TrajectoryRequest> without_repeats(const TrajectoryRequest& request) {
  TrajectoryRequest kept = request;
  kept.points = {request.points.front()};
  for (std::size_t k = 1; k < request.points.size(); ++k) {
    const bool repeats = is_repeat(request.points, k);
    if (repeats && kept.points.size() == 1) continue;  // the first waypoint keeps time 0
    if (repeats) kept.points.pop_back();               // the last waypoint keeps its position
    kept.points.push_back(request.points[k]);
  }
  if (kept.points.size() == request.points.size()) return std::nullopt;
  return kept;
}

Result<TrajectoryPtr> validate_as_given(const TrajectoryRequest& request, const Cell& cell,
                                        double& too_fast) {
  ProblemList problems;
  Names names = resolve_names(request, cell, problems);
  std::vector<Duration> times;
  if (check_count(request, problems)) {
    check_members(request, problems);
    times = read_times(request, problems);
  }
  if (!problems.empty()) return failure(std::move(problems).take());

  CheckedSegments checked = checked_segments(request, times, names.joints, cell, problems);
  too_fast = checked.too_fast;
  if (!problems.empty()) return failure(std::move(problems).take());
  return std::make_shared<const Trajectory>(std::move(names.joints), std::move(names.arms),
                                            std::move(checked.segments), request.is_made_here);
}

// Returns a factor near the largest velocity scaling factor with which the request is valid,
// rounded down to three decimals. Returns nullopt if none of the factors tried is valid.
std::optional<double> passing_factor(const TrajectoryRequest& request, const Cell& cell,
                                     double too_fast) {
  for (const double margin : {1.0, 0.99, 0.95}) {
    const double factor = std::floor(1000.0 * margin / too_fast) / 1000.0;
    if (factor <= 0.0) return std::nullopt;
    TrajectoryRequest slower = request;
    slow_down(slower, factor);
    double ignored = 0.0;
    if (validate_as_given(slower, cell, ignored)) return factor;
  }
  return std::nullopt;
}

bool is_of_speed(const Problem& problem) {
  return problem.slug == "velocity-limit" || problem.slug == "acceleration-limit";
}

// Adds a remedy to the first problem if the motion only breaks limits of velocity or acceleration.
void add_remedy(const TrajectoryRequest& request, const Cell& cell, double too_fast,
                Problems& problems) {
  if (!std::ranges::all_of(problems, is_of_speed) || !std::isfinite(too_fast)) return;
  std::string& detail = problems.front().detail;
  detail += " (tolerance " + to_text(100.0 * cell.checking.limit_tolerance) + " %)";
  if (const auto factor = passing_factor(request, cell, too_fast)) {
    detail += "; \"velocity_scaling_factor\": " + to_text(*factor * request.scaled_by) + " passes";
  }
  detail += kRetimeRemedy;
}

// Returns true if the only waypoints without velocities are the first and the last.
bool lacks_only_end_velocities(const TrajectoryRequest& request) {
  const std::vector<WaypointRequest>& points = request.points;
  if (points.size() < 2 || request.joint_names.empty()) return false;
  if (!points.front().velocities.empty() && !points.back().velocities.empty()) return false;
  return std::none_of(points.begin() + 1, points.end() - 1,
                      [](const WaypointRequest& p) { return p.velocities.empty(); });
}

TrajectoryRequest with_end_velocities(TrajectoryRequest request) {
  for (WaypointRequest* end : {&request.points.front(), &request.points.back()}) {
    if (end->velocities.empty()) end->velocities.assign(request.joint_names.size(), 0.0);
  }
  return request;
}

// Validates the request as given and, if this fails, without repeated waypoints.
Result<TrajectoryPtr> validate_without_repeats(const TrajectoryRequest& request, const Cell& cell,
                                               double& too_fast) {
  auto as_given = validate_as_given(request, cell, too_fast);
  const std::size_t count = request.points.size();
  if (as_given || count == 0 || count > kWaypointsMax) return as_given;
  const auto kept = without_repeats(request);
  if (!kept) return as_given;
  double of_kept = 0.0;
  auto valid = validate_as_given(*kept, cell, of_kept);
  return valid ? valid : as_given;
}

}  // namespace

void slow_down(TrajectoryRequest& request, double factor) {
  if (request.retime) request.retime->velocity = factor;
  request.scaled_by *= factor;
  for (WaypointRequest& point : request.points) {
    point.time_from_start_s /= factor;
    for (double& velocity : point.velocities) velocity *= factor;
    for (double& acceleration : point.accelerations) acceleration *= factor * factor;
  }
}

Result<TrajectoryPtr> validate(const TrajectoryRequest& request, const Cell& cell) {
  if (request.retime && !request.retime->only_if_needed) return retimed(request, cell);
  if (lacks_only_end_velocities(request)) {
    return validate(with_end_velocities(request), cell);
  }
  double too_fast = 0.0;
  auto valid = validate_without_repeats(request, cell, too_fast);
  if (valid) return valid;
  if (request.retime) return retimed(request, cell);
  if (!request.is_made_here) add_remedy(request, cell, too_fast, valid.error());
  return valid;
}

}  // namespace armloom
