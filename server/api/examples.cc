#include "server/api/examples.h"

namespace armloom {
namespace {

constexpr const char* kZeros = "[0, 0, 0, 0, 0, 0, 0]";

std::string joints(const std::string& arm) {
  std::string names;
  for (int i = 1; i <= 7; ++i) {
    names += (names.empty() ? "\"" : ", \"") + arm + "_panda_joint" + std::to_string(i) + "\"";
  }
  return "[" + names + "]";
}

std::string waypoint(const std::string& positions, const std::string& time,
                     bool accelerations = true) {
  std::string text = R"({"positions": [)" + positions + R"(], "velocities": )" + kZeros;
  if (accelerations) text.append(R"(, "accelerations": )").append(kZeros);
  return text.append(R"(, "time_from_start": )").append(time).append("}");
}

std::string trajectory(const std::string& arm, const std::string& from, const std::string& to) {
  return R"({"joint_names": )" + joints(arm) + R"(, "points": [)" + from + ", " + to + "]}";
}

constexpr const char* kHome = "0, -1.2, 0, -2.6, 0, 1.6, 0.785";
constexpr const char* kMiddle = "0, -0.4, 0, -1.2, 0, 2.0, 0.785";
constexpr const char* kTurned = "1.2, -1.2, 0, -2.6, 0, 1.6, 0.785";

}  // namespace

std::string example_job(const std::string& head, const std::string& arm) {
  return "{" + head + R"("trajectory": )" +
         trajectory(arm, waypoint(kHome, R"({"sec": 0, "nanosec": 0})"),
                    waypoint(kMiddle, R"({"sec": 3, "nanosec": 0})")) +
         "}";
}

std::string example_moveit_job() {
  return R"({"id": "swing", "trajectory": {"joint_trajectory": )" +
         trajectory("right", waypoint(kHome, R"({"secs": 0, "nsecs": 0})", false),
                    waypoint(kTurned, R"({"secs": 4, "nsecs": 0})", false)) +
         "}}";
}

std::string example_batch() {
  const auto job = [](const std::string& arm) {
    return R"({"id": "batch-)" + arm + R"(", "trajectory": )" +
           trajectory(arm, waypoint(kHome, "0"), waypoint(kTurned, "4")) + "}";
  };
  return R"({"jobs": [)" + job("left") + ", " + job("right") + R"(], "atomic": true})";
}

}  // namespace armloom
