#pragma once

#include <string>
#include <string_view>

#include "core/base/problem.h"

namespace armloom {

// Maximum number of values in a YAML text, counted as often as aliases repeat them.
inline constexpr std::size_t kYamlValuesMax = 1'200'000;

// Converts one YAML document to JSON text, for example a message as `ros2 topic echo` prints it.
// Empty documents are skipped ("---" at the end). Unquoted scalars are read as in YAML 1.2's core
// schema: null, true, numbers; others and quoted scalars are strings.
//
// Problem (malformed, or too_large beyond a limit): the detail names line and column. Values that
// `ros2 topic echo` left out ('...') are reported with the option that prints them.
[[nodiscard]] Result<std::string> json_of_yaml(std::string_view text);

}  // namespace armloom
