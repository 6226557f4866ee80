#pragma once

#include "server/codec/part.h"

namespace armloom::formats {

// Makes members optional for reading because older versions did not store or record them. This
// version always writes them.
[[nodiscard]] AnyPartPtr later(const AnyPartPtr& part);
template <class T>
[[nodiscard]] PartPtr<T> later(const PartPtr<T>& part) {
  return PartPtr<T>(later(part.any()));
}

}  // namespace armloom::formats
