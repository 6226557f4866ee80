#include "core/trajectory/timing/retime.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/trajectory/request_checks.h"
#include "core/trajectory/timing/time_parameterization.h"

namespace armloom {
namespace {

void check_position(const TrajectoryRequest& request, std::size_t k, std::size_t j, double value,
                    const Joint& joint, ProblemList& problems) {
  if (is_within_limits(joint, value)) return;
  problems.add({ProblemKind::invalid, "position-limit",
                pointer_to(request, k) + "/positions/" + std::to_string(j),
                waypoint(request, k) + ", " + joint.name + ": position " + to_text(value) +
                    " is outside [" + to_text(joint.lower) + ", " + to_text(joint.upper) + "]",
                value});
}

std::vector<Eigen::VectorXd> way_of(const TrajectoryRequest& request) {
  std::vector<Eigen::VectorXd> way;
  for (const WaypointRequest& point : request.points) {
    const Eigen::Map<const Eigen::VectorXd> at(point.positions.data(),
                                               static_cast<Eigen::Index>(point.positions.size()));
    way.emplace_back(at);
  }
  return way;
}

// Returns the distance of a point from the chord between two points.
double distance_to_chord(const Eigen::VectorXd& point, const Eigen::VectorXd& from,
                         const Eigen::VectorXd& to) {
  const Eigen::VectorXd chord = to - from;
  const double length2 = chord.squaredNorm();
  const double share = length2 > 0.0 ? chord.dot(point - from) / length2 : 0.0;
  return (point - from - std::clamp(share, 0.0, 1.0) * chord).norm();
}

// A chord replaces at most this many steps between waypoints, so that the computing time is linear
// in the number of waypoints.
constexpr std::size_t kSpanMax = 64;

std::vector<Eigen::VectorXd> thinned(const std::vector<Eigen::VectorXd>& way) {
  std::vector<Eigen::VectorXd> kept{way.front()};
  for (std::size_t from = 0; from + 1 < way.size();) {
    const auto is_passed = [&](std::size_t to) {
      for (std::size_t k = from + 1; k < to; ++k) {
        if (distance_to_chord(way[k], way[from], way[to]) > kThinWithin) return false;
      }
      return true;
    };
    std::size_t to = from + 1;
    while (to + 1 < way.size() && to - from < kSpanMax && is_passed(to + 1)) ++to;
    kept.push_back(way[to]);
    from = to;
  }
  // Otherwise the path only goes there and back.
  return JointPath::leads_somewhere(kept) ? kept : way;
}

// Returns a remedy for too many waypoints.
std::string remedy(std::size_t given, double made) {
  const double share = static_cast<double>(kWaypointsMax) / made;
  const auto of_each = static_cast<std::size_t>(0.9 * share * static_cast<double>(given));
  return "the " + std::to_string(given) + " waypoints become " + to_text(made) +
         " by time parameterization, but a motion has at most " + std::to_string(kWaypointsMax) +
         ": split the path into several jobs of at most " + std::to_string(of_each) +
         " waypoints each, or fewer waypoints";
}

}  // namespace

Result<TrajectoryPtr> retimed(const TrajectoryRequest& request, const Cell& cell) {
  ProblemList problems;
  const Names names = resolve_names(request, cell, problems);
  if (check_count(request, problems)) {
    for (std::size_t k = 0; k < request.points.size() && !problems.full(); ++k) {
      check_numbers(k, "positions", request.points[k].positions, request, problems);
    }
  }
  if (!problems.empty()) return failure(std::move(problems).take());
  for (std::size_t k = 0; k < request.points.size(); ++k) {
    for (std::size_t j = 0; j < names.joints.size(); ++j) {
      check_position(request, k, j, request.points[k].positions[j], cell.joint(names.joints[j]),
                     problems);
    }
  }
  const std::vector<Eigen::VectorXd> way = way_of(request);
  if (problems.empty() && !JointPath::leads_somewhere(way)) {
    problems.add({ProblemKind::invalid,
                  "no-way",
                  "/points",
                  "all waypoints are equal: there is no path to time",
                  {}});
  }
  if (!problems.empty()) return failure(std::move(problems).take());
  const auto path = JointPath::rounded(thinned(way), kRetimeWithin - kThinWithin);
  auto timed = time_path(cell, names.joints, path,
                         {.shares = {.velocity = request.retime->velocity.value_or(
                                         cell.execution.velocity_scaling_factor)}});
  if (timed) return std::move(timed->trajectory);
  for (Problem& problem : timed.error()) {
    problem.pointer = "/points";
    const auto* made = std::get_if<double>(&problem.value);
    if (problem.kind == ProblemKind::too_large && made != nullptr) {
      problem.detail = remedy(request.points.size(), *made);
    } else {
      problem.detail.insert(0, "after time parameterization: ");
    }
  }
  return failure(std::move(timed.error()));
}

}  // namespace armloom
