#pragma once

#include <string>
#include <vector>

#include "core/arm/make_controller.h"
#include "server/messages/fault.h"

namespace armloom {

// Knows which faults the simulated arms have. Use on the executive's strand.
class FaultTargets {
 public:
  // Returns controllers whose faults list() returns while the controllers live.
  [[nodiscard]] ControllerTypes watched(ControllerTypes types);

  // Returns the faults that are not over, in order of ids. Faults that occur once are over when
  // they have occurred.
  [[nodiscard]] FaultListing list(TimePoint now) const;

 private:
  struct Target {
    std::string arm;
    const FaultTarget* faults;
  };
  std::vector<Target> targets_;
};

}  // namespace armloom
