#pragma once

#include <cstdint>
#include <optional>

#include "core/base/time.h"

namespace armloom {

struct ArmFault {
  enum class Kind {
    stall,       // stops on its path, then continues
    slow,        // follows its path at `value` (0..1) of its speed
    late_start,  // starts each motion `value` seconds late
    // Commands still reach the arm, but no report comes back.
    drop_feedback,
    // The controller gives up once: brakes and reports a fault, in the present or next motion.
    fault,
    // The arm's first joint leaves its path, or the position where it rests, at `value` rad/s
    // (m/s), until the arm is braked. The deviation remains.
    drift,
  };
  Kind kind;
  TimePoint from;
  std::optional<TimePoint> until;  // unlimited if nullopt
  double value = 0.0;
};

// Something into which faults can be injected: a simulated controller or its connection.
class FaultTarget {
 public:
  virtual ~FaultTarget() = default;
  // Adds a fault under an unused `id`.
  virtual void inject(std::uint64_t id, ArmFault fault) = 0;
  // Returns false if there is no such fault.
  virtual bool remove(std::uint64_t id) = 0;
};

}  // namespace armloom
