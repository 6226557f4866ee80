#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/trajectory/check_limits.h"

// Internal to core/trajectory: stages of validate() that also apply to requests without times.
// validate.h lists the problems.
namespace armloom {

// Names of a waypoint as the client counts: "/points/3", "waypoint 3", "between waypoints 3 and 4".
// An inserted start does not count; it is "the arm's position at the start".
[[nodiscard]] std::string pointer_to(const TrajectoryRequest& request, std::size_t waypoint);
[[nodiscard]] std::string waypoint(const TrajectoryRequest& request, std::size_t index);
[[nodiscard]] std::string before_waypoint(const TrajectoryRequest& request, std::size_t index);

// Remedy for missing or unusable times, velocities and accelerations.
inline constexpr const char* kRetimeRemedy =
    "; or let the server compute times and velocities along the path (\"retime\": true in the job)";

struct Names {
  std::vector<JointId> joints;
  std::vector<ArmId> arms;  // ascending, each once
};

[[nodiscard]] Names resolve_names(const TrajectoryRequest& request, const Cell& cell,
                                  ProblemList& problems);
// Returns true if the number of waypoints is allowed.
[[nodiscard]] bool check_count(const TrajectoryRequest& request, ProblemList& problems);
// Adds a problem unless `numbers` has one finite number for each joint.
void check_numbers(std::size_t k, const char* member, const std::vector<double>& numbers,
                   const TrajectoryRequest& request, ProblemList& problems);

}  // namespace armloom
