#pragma once

#include <optional>

#include "core/base/ids.h"
#include "core/coordination/conflict_region.h"

namespace armloom {

// Evidence that an arm must not be given authority.
struct GuardRefusal {
  enum class Why {
    uncertified,  // no valid certificate covers it: ask the checker for one
    region,       // a certificate covers it, and the product of authorities meets a region
    busy,         // the arm is on another motion
    out_of_step,  // the arms of the motion are farther apart on it than is certified
  };
  Why why = Why::uncertified;
  ArmId arm{0};                     // that may not go
  std::optional<ArmId> other = {};  // nullopt: the scene, or the arms of the same motion
  ProgressBox asked = {};           // progress of `arm`, progress of `other`, up to authority
  std::optional<ProgressBox> region = {};  // Why::region: the first rectangle that is met
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
