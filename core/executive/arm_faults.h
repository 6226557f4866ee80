#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/arm/faulty_arm.h"
#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// A fault of a simulated arm, as a client asks for it.
struct FaultRequest {
  std::string arm;
  ArmFault::Kind kind = ArmFault::Kind::stall;
  std::optional<TimePoint> at;      // absent: now
  std::optional<Duration> lasting;  // absent: until removed; a fault strikes once
  double value = 0.0;
};

struct ExecutiveInput;

// Faults of the simulated arms, which clients put in and take out.
class ArmFaults {
 public:
  // Told what a client wants, good or not; answers what time it is.
  using Asked = std::function<TimePoint(const ExecutiveInput&)>;
  // The arms, by ArmId, outlive it.
  ArmFaults(CellPtr cell, const std::vector<std::unique_ptr<FaultyArm>>& arms, Asked asked);

  // Its number. Problem: an unknown arm.
  [[nodiscard]] Result<std::uint64_t> inject(const FaultRequest& request);
  // Problem: an unknown fault.
  [[nodiscard]] Result<void> remove(std::uint64_t id);

 private:
  CellPtr cell_;
  std::vector<FaultyArm*> arms_;
  Asked asked_;
  std::uint64_t next_ = 1;
};

}  // namespace armloom
