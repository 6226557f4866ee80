#pragma once

#include "server/codec/part.h"

namespace armloom::formats {

// Members that came later: this version tells them always, but what older ones stored and recorded
// lacks them and is read, too.
[[nodiscard]] AnyPartPtr later(const AnyPartPtr& part);
template <class T>
[[nodiscard]] PartPtr<T> later(const PartPtr<T>& part) {
  return PartPtr<T>(later(part.any()));
}

}  // namespace armloom::formats
