#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/base/number_range.h"
#include "core/base/time.h"
#include "server/codec/format.h"

namespace armloom::formats {

using Range = NumberRange;
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{0.0, std::numeric_limits<double>::infinity(), true};

[[nodiscard]] FormatPtr<double> number(Range range);
[[nodiscard]] FormatPtr<Duration> seconds(Range range);
[[nodiscard]] FormatPtr<std::string> text();
// Describes a text that must not be empty.
[[nodiscard]] FormatPtr<std::string> name();
// Describes a path, which must not be empty. map_paths() replaces it unless it is a URL
// (https://...).
[[nodiscard]] FormatPtr<std::string> path();
// Describes a text that is one of these names.
[[nodiscard]] FormatPtr<std::string> one_of(std::vector<std::string> names);
// Describes an array of fixed size. All numbers must be in the range.
[[nodiscard]] FormatPtr<Eigen::Vector3d> vector3(Range range);
template <std::size_t size>
[[nodiscard]] FormatPtr<std::array<double, size>> numbers(Range range);

}  // namespace armloom::formats
