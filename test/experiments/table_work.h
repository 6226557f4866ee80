#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "test/experiments/job_maker.h"

// Building blocks of jobs over a table.
namespace armloom::experiments {

// Time for closing or opening the fingers.
inline constexpr double kGrip_s = 0.3;

// A tool position over the table, low and above.
struct Spot {
  Eigen::VectorXd low;
  Eigen::VectorXd above;
};
struct Box2 {
  double x0, x1, y0, y1;
};
// For two arms face to face, in meters: the tray of each arm in its base frame, and the middle
// between the arms.
inline constexpr Box2 kTray_B{0.05, 0.25, 0.38, 0.52};
inline constexpr Box2 kMiddle_W{-0.06, 0.06, -0.15, 0.15};

// Draws a position in the box; nullopt if the arm cannot reach it.
[[nodiscard]] std::optional<Spot> spot_in(JobMaker& maker, ArmId arm, const Box2& box_W);
// Draws a position in the arm's own tray, in its base frame, which faces the middle.
[[nodiscard]] std::optional<Spot> spot_in_tray(JobMaker& maker, ArmId arm, const Box2& box_B);

// Wanted duration of a whole path, reached by slowing down one leg.
struct WantedTime {
  double whole_s;
  std::size_t slowed;
};
// Slows the path from `start` down to that duration; returns false if it takes longer anyway.
[[nodiscard]] bool fill_time(const Cell& cell, ArmId arm, const Eigen::VectorXd& start,
                             const WantedTime& wanted, std::vector<Leg>& legs);

// Repeats until the task is accepted. Throws std::runtime_error if no attempt succeeds.
void until_taken(const std::function<bool()>& task);

}  // namespace armloom::experiments
