#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "test/experiments/job_maker.h"

// What jobs over a table are made of.
namespace armloom::experiments {

// How long the fingers close or open.
inline constexpr double kGrip_s = 0.3;

// A tool position over the table, low and above.
struct Spot {
  Eigen::VectorXd low;
  Eigen::VectorXd above;
};
struct Box2 {
  double x0, x1, y0, y1;
};
// Of two arms that stand face to face, in metres: the tray of each, in the frame of its base, and
// the middle between them.
inline constexpr Box2 kTray_B{0.05, 0.25, 0.38, 0.52};
inline constexpr Box2 kMiddle_W{-0.06, 0.06, -0.15, 0.15};

// A place drawn from the box; none: the arm does not reach it.
[[nodiscard]] std::optional<Spot> spot_in(JobMaker& maker, ArmId arm, const Box2& box_W);
// The arm's own tray, in the frame of its base, which looks to the middle.
[[nodiscard]] std::optional<Spot> spot_in_tray(JobMaker& maker, ArmId arm, const Box2& box_B);

// What a whole way is to take, by one leg of it that goes more slowly.
struct WantedTime {
  double whole_s;
  std::size_t slowed;
};
// Slows the way from `start` down to that; false: it takes longer anyway.
[[nodiscard]] bool fill_time(const Cell& cell, ArmId arm, const Eigen::VectorXd& start,
                             const WantedTime& wanted, std::vector<Leg>& legs);

// Draws again until the task is taken. Throws std::runtime_error when none is found.
void until_taken(const std::function<bool()>& task);

}  // namespace armloom::experiments
