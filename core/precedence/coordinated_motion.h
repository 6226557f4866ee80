#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"

namespace armloom {

// What is known of a motion besides its progress.
struct Outlook {
  bool keeps_its_place = false;  // has been overtaken long enough
  // Its arms have stood for so long without a reason of ours: they are expected to do so for as
  // long again.
  Duration stands_for{};
  double pace = 1.0;  // of cell time for one of its trajectory, as measured: it goes on so
};

// A motion that is admitted, or is to be. Of one arm the motions follow each other as they stand in
// the list that they are given in; each begins where the one before ends.
struct CoordinatedMotion {
  JobId job;
  std::vector<ArmId> arms;
  Duration duration;
  Duration progress{};   // as measured
  Duration authority{};  // granted so far: no way back behind it
  std::optional<Duration> held_at =
      {};  // an arm rests in its way there, and no motion takes it away
  int priority = 0;
  Duration horizon{};  // how far ahead of its progress its authority may reach
  Outlook outlook = {};

  // Has passed what ends at `to`; its goal it never passes.
  [[nodiscard]] bool is_beyond(Duration to) const { return to < progress && to < duration; }
};

[[nodiscard]] inline bool share_an_arm(const CoordinatedMotion& a, const CoordinatedMotion& b) {
  return std::ranges::any_of(
      a.arms, [&](ArmId arm) { return std::ranges::find(b.arms, arm) != b.arms.end(); });
}

}  // namespace armloom
