#pragma once

#include <optional>

#include "core/base/ids.h"
#include "core/coordination/conflict_region.h"

namespace armloom {

// Evidence that an arm must not be given authority.
struct GuardRefusal {
  enum class Why {
    uncertified,  // no valid certificate: ask the checker
    region,       // the positions that the arms could reach overlap a conflict region
    busy,         // the arm is executing another motion
    out_of_step,  // the motion's arms are too far apart in progress
  };
  Why why = Why::uncertified;
  ArmId arm{0};  // the refused arm
  // Counterpart; nullopt if this is the scene or an arm of the same motion.
  std::optional<ArmId> other = {};
  ProgressBox asked = {};  // progress of `arm` and of `other`, up to their authority
  std::optional<ProgressBox> region = {};  // Why::region: the first rectangle that overlaps `asked`
};
[[nodiscard]] constexpr const char* to_string(GuardRefusal::Why why) {
  switch (why) {
    case GuardRefusal::Why::uncertified:
      return "uncertified";
    case GuardRefusal::Why::region:
      return "region";
    case GuardRefusal::Why::busy:
      return "busy";
    case GuardRefusal::Why::out_of_step:
      return "out_of_step";
  }
  return nullptr;
}

}  // namespace armloom
