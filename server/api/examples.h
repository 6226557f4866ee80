#pragma once

#include <string>

namespace armloom {

// Example bodies for the two-Panda cell.

// Returns a job whose motion starts at home, with ROS 2 times. `head`: members before `trajectory`,
// each followed by a comma.
[[nodiscard]] std::string example_job(const std::string& head, const std::string& arm);
// Returns a job with ROS 1 times and MoveIt's nesting.
[[nodiscard]] std::string example_moveit_job();
[[nodiscard]] std::string example_batch();

}  // namespace armloom
