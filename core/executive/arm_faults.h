#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/arm/faulty_arm.h"
#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

struct FaultRequest;

// Faults of the simulated arms, which clients put in and take out.
class ArmFaults {
 public:
  // The arms, by ArmId, outlive it.
  ArmFaults(CellPtr cell, const std::vector<std::unique_ptr<FaultyArm>>& arms);

  // Its number. Problem: an unknown arm.
  [[nodiscard]] Result<std::uint64_t> inject(const FaultRequest& request, TimePoint now);
  // Problem: an unknown fault.
  [[nodiscard]] Result<void> remove(std::uint64_t id);

 private:
  CellPtr cell_;
  std::vector<FaultyArm*> arms_;
  std::uint64_t next_ = 1;
};

}  // namespace armloom
