#pragma once

#include <string>

namespace armloom {

// Bodies for people to try on the two-Panda cell.

// A motion of an arm that stands at home, times as ROS 2 has them. `head`: members before it, with
// a comma behind each.
[[nodiscard]] std::string example_job(const std::string& head, const std::string& arm);
// The same for ROS 1 and nested as MoveIt prints it.
[[nodiscard]] std::string example_moveit_job();
[[nodiscard]] std::string example_batch();

}  // namespace armloom
