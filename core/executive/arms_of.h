#pragma once

#include <string>
#include <vector>

#include "core/model/cell.h"

namespace armloom {

[[nodiscard]] inline std::vector<ArmId> all_arms(const Cell& cell) {
  std::vector<ArmId> arms;
  for (std::size_t a = 0; a < cell.arms.size(); ++a) {
    arms.emplace_back(static_cast<std::uint32_t>(a));
  }
  return arms;
}

[[nodiscard]] inline std::vector<std::string> each_name(const Cell& cell,
                                                        const std::vector<ArmId>& arms) {
  std::vector<std::string> names;
  names.reserve(arms.size());
  for (ArmId arm : arms) names.push_back(cell.arm(arm).name);
  return names;
}

// "left, right"
[[nodiscard]] inline std::string names_of(const Cell& cell, const std::vector<ArmId>& arms) {
  std::string names;
  for (ArmId arm : arms) names += (names.empty() ? "" : ", ") + cell.arm(arm).name;
  return names;
}

}  // namespace armloom
