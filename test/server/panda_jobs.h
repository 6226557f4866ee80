#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

namespace armloom::test {

using Pose = std::array<double, 7>;

// Poses of the two-Panda cell (rad).
inline constexpr Pose kHome{0, -1.2, 0, -2.6, 0, 1.6, 0.785};
// The pose "coop_up". The arms collide if both are at this pose.
inline constexpr Pose kMiddle{0, -0.7, 0, -1.8, 0, 2.6, 0};

// Returns a quintic motion from rest to rest through `points` waypoints, as a body of POST /jobs.
inline nlohmann::json move(const std::string& arm, const Pose& from, const Pose& to,
                           double duration_s = 3.0, int points = 11) {
  nlohmann::json names = nlohmann::json::array();
  for (int j = 1; j <= 7; ++j) names.push_back(arm + "_panda_joint" + std::to_string(j));
  nlohmann::json waypoints = nlohmann::json::array();
  for (int i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / (points - 1);
    const double position = s * s * s * (10 + s * (6 * s - 15));
    const double velocity = 30 * s * s * (1 - s) * (1 - s) / duration_s;
    const double acceleration = 60 * s * (1 - s) * (1 - 2 * s) / (duration_s * duration_s);
    nlohmann::json point = {{"time_from_start", s * duration_s}};
    for (std::size_t j = 0; j < 7; ++j) {
      const double span = to[j] - from[j];
      point["positions"].push_back(from[j] + span * position);
      point["velocities"].push_back(span * velocity);
      point["accelerations"].push_back(span * acceleration);
    }
    waypoints.push_back(point);
  }
  return {{"trajectory", {{"joint_names", names}, {"points", waypoints}}}};
}

}  // namespace armloom::test
