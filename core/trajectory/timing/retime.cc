#include "core/trajectory/timing/retime.h"

#include <string>
#include <utility>
#include <vector>

#include "core/trajectory/request_checks.h"
#include "core/trajectory/timing/time_parameterisation.h"

namespace armloom {
namespace {

void check_position(std::size_t k, std::size_t j, double value, const Joint& joint,
                    ProblemList& problems) {
  if (is_within_limits(joint, value)) return;
  problems.add({ProblemKind::invalid, "position-limit",
                pointer_to(k) + "/positions/" + std::to_string(j),
                waypoint(k) + ", " + joint.name + ": position " + to_text(value) + " is outside [" +
                    to_text(joint.lower) + ", " + to_text(joint.upper) + "]",
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
      check_position(k, j, request.points[k].positions[j], cell.joint(names.joints[j]), problems);
    }
  }
  const std::vector<Eigen::VectorXd> way = way_of(request);
  if (problems.empty() && !JointPath::leads_somewhere(way)) {
    problems.add({ProblemKind::invalid,
                  "no-way",
                  "/points",
                  "all waypoints are one place: there is no way to give times to",
                  {}});
  }
  if (!problems.empty()) return failure(std::move(problems).take());
  auto timed = time_path(cell, names.joints, JointPath::rounded(way, kRetimeWithin),
                         {.shares = {.velocity = request.retime->velocity.value_or(
                                         cell.execution.velocity_scaling_factor)}});
  if (timed) return std::move(timed->trajectory);
  for (Problem& problem : timed.error()) {
    problem.pointer = "/points";
    problem.detail.insert(0, "with the times that were made: ");
  }
  return failure(std::move(timed.error()));
}

}  // namespace armloom
