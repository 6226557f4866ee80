#include "server/codec/format.h"

#include <cmath>
#include <cstdint>

namespace armloom {

Schema as_json(double number) {
  constexpr double kWholeMax = 1e15;
  if (std::abs(number) <= kWholeMax && number == std::trunc(number)) {
    return static_cast<std::int64_t>(number);
  }
  return number;
}

Schema as_json(const JsonWriter& written) { return Schema::parse(written.text()); }

}  // namespace armloom
