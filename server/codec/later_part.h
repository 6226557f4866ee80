#pragma once

#include "server/codec/part.h"

namespace armloom::formats {

// Makes the members of a part optional in schemas, because earlier versions did not write them.
[[nodiscard]] AnyPartPtr later(const AnyPartPtr& part);
template <class T>
[[nodiscard]] PartPtr<T> later(const PartPtr<T>& part) {
  return PartPtr<T>(later(part.any()));
}

}  // namespace armloom::formats
