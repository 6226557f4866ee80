#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// Knowledge about a motion besides its progress.
struct Outlook {
  bool keeps_its_place = false;  // was overtaken long enough
  // How long its arms have rested without being held back by orders; they are predicted to rest for
  // as long again.
  Duration stands_for{};
  double pace = 1.0;  // cell time per trajectory time, as measured and predicted
};

// A motion that is admitted, or a candidate. In a list of motions, those of one arm are in running
// order; each begins where the previous one ends.
struct CoordinatedMotion {
  JobId job;
  std::vector<ArmId> arms;
  Duration duration;
  Duration progress{};                   // as measured
  Duration authority{};                  // granted so far; never reduced
  std::optional<Duration> held_at = {};  // limit set by an arm at rest in its path
  int priority = 0;
  Duration horizon{};  // how far its authority may exceed its progress
  Outlook outlook = {};

  // Returns true if the motion has passed an interval that ends at `to`; never for its goal.
  [[nodiscard]] bool is_beyond(Duration to) const { return to < progress && to < duration; }
};

[[nodiscard]] inline bool share_an_arm(const CoordinatedMotion& a, const CoordinatedMotion& b) {
  return std::ranges::any_of(
      a.arms, [&](ArmId arm) { return std::ranges::find(b.arms, arm) != b.arms.end(); });
}

}  // namespace armloom
