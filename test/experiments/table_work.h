#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "test/experiments/job_maker.h"

namespace armloom::experiments {

inline constexpr double kGrip_s = 0.3;

struct Spot {
  Eigen::VectorXd low;
  Eigen::VectorXd above;
};
struct Box2 {
  double x0, x1, y0, y1;
};
// Areas (m) for two arms face to face: each arm's tray in the arm's base frame, and the middle in
// the world frame.
inline constexpr Box2 kTray_B{0.05, 0.25, 0.38, 0.52};
inline constexpr Box2 kMiddle_W{-0.06, 0.06, -0.15, 0.15};

// Draws a position in the area; nullopt if the arm cannot reach it.
[[nodiscard]] std::optional<Spot> spot_in(JobMaker& maker, ArmId arm, const Box2& box_W);
// Draws a position in the arm's own tray, an area in its base frame. The base faces the middle.
[[nodiscard]] std::optional<Spot> spot_in_tray(JobMaker& maker, ArmId arm, const Box2& box_B);

struct WantedTime {
  double whole_s;
  std::size_t slowed;
};
// Slows leg wanted.slowed so that all legs take wanted.whole_s. Returns false if they take longer
// already.
[[nodiscard]] bool fill_time(const Cell& cell, ArmId arm, const Eigen::VectorXd& start,
                             const WantedTime& wanted, std::vector<Leg>& legs);

// Throws std::runtime_error if no attempt succeeds.
void until_taken(const std::function<bool()>& task);

}  // namespace armloom::experiments
