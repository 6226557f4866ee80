#pragma once

#include <vector>

#include "core/base/time.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// Contents of a cell besides its links, from `time` on.
struct RecordedScene {
  TimePoint time{};
  std::vector<CollisionObject> objects;
  std::vector<Attachment> held = {};     // objects that arms hold; not in `objects`
  std::vector<AllowedTouch> touch = {};  // of `objects`
};

}  // namespace armloom
