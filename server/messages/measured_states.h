#pragma once

#include <string>
#include <vector>

#include "core/base/time.h"
#include "core/model/cell.h"
#include "server/codec/format.h"

namespace armloom {

// Answer to GET /states, column by column.
struct MeasuredStates {
  std::string stream;
  std::vector<std::string> joints;
  std::vector<TimePoint> times;  // ascending
  std::vector<Configuration> q;  // per time, in the order of joints; rad or m
};
[[nodiscard]] FormatPtr<MeasuredStates> measured_states_format();

}  // namespace armloom
