#pragma once

#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/model/cell.h"
#include "server/codec/format.h"

namespace armloom {

// The answer to GET /states: joint positions over the last minutes, as columns.
struct MeasuredStates {
  std::string stream;
  std::vector<std::string> joints;
  std::vector<TimePoint> times;  // ascending
  std::vector<Configuration> q;  // at each of these, in the order of the joints; rad or m
};
[[nodiscard]] FormatPtr<MeasuredStates> measured_states_format();

}  // namespace armloom
