#include "server/http/reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <string_view>
#include <unordered_map>

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
  if (held_.empty()) return let_one_go();
  close(held_.back());
  held_.pop_back();
  return true;
}

bool Reserve::Place::keep(bool is_kept) {
  const auto mine = reserve_.inside_.find(number_);
  if (mine == reserve_.inside_.end()) return false;
  mine->second.is_kept = is_kept;
  return true;
}

bool Reserve::let_one_go() {
  std::unordered_map<std::string_view, int> places_of;
  for (const auto& [number, one] : inside_) places_of[one.client] += one.is_kept ? 0 : 1;
  auto goes = inside_.end();
  for (auto one = inside_.begin(); one != inside_.end(); ++one) {
    if (one->second.is_kept) continue;
    const bool has_more =
        goes == inside_.end() || places_of[one->second.client] > places_of[goes->second.client];
    if (has_more) goes = one;
  }
  if (goes == inside_.end()) return false;
  ErrorCode ignored;
  goes->second.socket->close(ignored);
  inside_.erase(goes);
  return true;
}

}  // namespace armloom
