#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/trajectory/check_limits.h"

// Internal to core/trajectory: stages of validate() that also apply to requests without times.
// Slugs and messages: validate.h.
namespace armloom {

[[nodiscard]] std::string pointer_to(std::size_t waypoint);  // "/points/3"
[[nodiscard]] std::string waypoint(std::size_t index);       // "waypoint 3"

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
// Requires one finite number for each joint.
void check_numbers(std::size_t k, const char* member, const std::vector<double>& numbers,
                   const TrajectoryRequest& request, ProblemList& problems);

}  // namespace armloom
