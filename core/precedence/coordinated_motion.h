#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// Knowledge about a motion in addition to its progress.
struct Outlook {
  bool keeps_its_place = false;  // has waited so long that no other motion may overtake it any more
  // How long the motion's arms have rested although no order holds them back. They are predicted to
  // rest for as long again.
  Duration stands_for{};
  double pace = 1.0;  // cell time per trajectory time, as measured and predicted
};

// A view of a step, admitted or a candidate, for the precedence graph. In a list, the motions of
// one arm are in running order, and each begins where the previous one ends.
struct CoordinatedMotion {
  StepId step;
  std::vector<ArmId> arms;
  Duration duration;
  Duration progress{};   // as measured
  Duration authority{};  // granted so far; never reduced
  int priority = 0;
  Duration horizon{};  // largest lead of its authority over its progress
  Outlook outlook = {};

  [[nodiscard]] bool moves(ArmId arm) const { return std::ranges::find(arms, arm) != arms.end(); }
  // Returns true if the motion has passed an interval of progress that ends at `to`. An interval
  // that includes the motion's end is never passed.
  [[nodiscard]] bool is_beyond(Duration to) const { return to < progress && to < duration; }
};

[[nodiscard]] inline bool share_an_arm(const CoordinatedMotion& a, const CoordinatedMotion& b) {
  return std::ranges::any_of(a.arms, [&](ArmId arm) { return b.moves(arm); });
}

}  // namespace armloom
