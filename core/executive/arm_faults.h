#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/arm/make_controller.h"
#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// A fault of a simulated arm, as requested by a client.
struct FaultRequest {
  std::string arm;
  ArmFault::Kind kind = ArmFault::Kind::stall;
  std::optional<TimePoint> at;      // nullopt: now
  std::optional<Duration> lasting;  // nullopt: until removed; `fault` occurs once
  double value = 0.0;
};

struct ExecutiveInput;

// Injects faults into the simulated arms, and removes them.
class ArmFaults {
 public:
  // Called with each request, also an invalid one. Returns the present time.
  using Asked = std::function<TimePoint(const ExecutiveInput&)>;
  // `arms`, by ArmId; their controllers outlive this object.
  ArmFaults(CellPtr cell, const std::vector<MadeController>& arms, Asked asked);

  // Returns the fault's number. Problems: an unknown arm; an arm whose controller takes no faults.
  [[nodiscard]] Result<std::uint64_t> inject(const FaultRequest& request);
  // Problem: an unknown fault.
  [[nodiscard]] Result<void> remove(std::uint64_t id);

 private:
  CellPtr cell_;
  std::vector<FaultTarget*> arms_;  // by ArmId; null if the controller takes no faults
  Asked asked_;
  std::uint64_t next_ = 1;
};

}  // namespace armloom
