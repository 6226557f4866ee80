#include "core/jobs/shared_hold.h"

#include <algorithm>

namespace armloom {

const SharedHold* hold_broken_by(const std::vector<ArmId>& moved,
                                 const std::vector<SharedHold>& holds) {
  const auto is_moved = [&](ArmId arm) { return std::ranges::count(moved, arm) > 0; };
  const auto is_broken = [&](const SharedHold& hold) {
    return std::ranges::any_of(hold.arms, is_moved) && !std::ranges::all_of(hold.arms, is_moved);
  };
  const auto broken = std::ranges::find_if(holds, is_broken);
  return broken == holds.end() ? nullptr : &*broken;
}

bool is_in(ArmId arm, const std::vector<SharedHold>& holds) {
  return std::ranges::any_of(
      holds, [&](const SharedHold& hold) { return std::ranges::count(hold.arms, arm) > 0; });
}

std::string text_of(const SharedHold& hold, const Cell& cell) {
  std::string names;
  for (const ArmId arm : hold.arms) names += (names.empty() ? "" : ", ") + cell.arm(arm).name;
  return names + " hold " + hold.object +
         " together and move only together: give one trajectory of all of them, or let one go "
         "first by a step {\"detach\": {\"object\", \"link\"}}; POST /scene/objects/" +
         hold.object + "/detach lets all go";
}

}  // namespace armloom
