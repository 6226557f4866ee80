#pragma once

#include "server/codec/member_part.h"
#include "server/codec/member_rules.h"
#include "server/codec/part_groups.h"

namespace armloom::formats {

// A function that calls use(address of an object with the defaults).
using WithDefaults = void (*)(const UseValue& use);

// Describes an object. Unknown keys in it are faults.
[[nodiscard]] AnyFormatPtr object_format(AnyParts parts, WithDefaults with_defaults);
template <class T>
[[nodiscard]] FormatPtr<T> object(const PartList<T>& parts) {
  return FormatPtr<T>(object_format(parts.any(), [](const UseValue& use) {
    const T defaults{};
    use(&defaults);
  }));
}

}  // namespace armloom::formats
