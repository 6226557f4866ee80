#include "server/http/reserve.h"

#include <fcntl.h>
#include <unistd.h>

namespace armloom {

Reserve::~Reserve() {
  for (const int descriptor : held_) close(descriptor);
}

void Reserve::fill() {
  while (held_.size() + inside_.size() < places_) {
    const int descriptor = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return;
    held_.push_back(descriptor);
  }
}

bool Reserve::make_room() {
  if (held_.empty()) return let_oldest_go();
  close(held_.back());
  held_.pop_back();
  return true;
}

bool Reserve::let_oldest_go() {
  if (inside_.empty()) return false;
  const auto oldest = inside_.begin();
  oldest->second->close();
  inside_.erase(oldest);
  return true;
}

}  // namespace armloom
