#pragma once

#include <string>
#include <vector>

#include "core/executive/arm_faults.h"

namespace armloom {

// A fault of the campaign, and what must come of it. Besides what `expected` says, this holds for
// every fault: no contact unless `may_touch`, and every job ends or states what it waits for.
struct ListedFault {
  std::string name;
  // Occur in one arm at the same time; `arm` and `at` are empty.
  std::vector<FaultRequest> faults;
  std::string expected;
  bool may_touch = false;  // stopping in time is not always possible (README.md)
};
[[nodiscard]] const std::vector<ListedFault>& listed_faults();

// Returns the list as a table in Markdown.
[[nodiscard]] std::string table_of_faults();

}  // namespace armloom
