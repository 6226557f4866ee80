#pragma once

#include <cmath>
#include <numbers>
#include <string>

namespace armloom {

// Returns ", 2 whole turns away: ..." if two revolute positions are whole turns apart (within the
// tolerance), else an empty string.
[[nodiscard]] inline std::string whole_turns_apart(double a_rad, double b_rad,
                                                   double tolerance_rad) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const double turns = std::round(std::abs(a_rad - b_rad) / kTurn_rad);
  if (turns == 0.0 || std::abs(std::abs(a_rad - b_rad) - turns * kTurn_rad) > tolerance_rad)
    return {};
  return ", " + std::to_string(std::lround(turns)) + " whole turn" + (turns > 1.0 ? "s" : "") +
         " away: positions are not taken modulo 2 pi";
}

}  // namespace armloom
