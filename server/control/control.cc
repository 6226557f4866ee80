#include "server/control/control.h"

#include <utility>

#include "server/access/digest.h"

namespace armloom {
Result<Control::Taken> Control::take(const std::string& who, bool from_another,
                                     std::optional<std::string> token) {
  if (holder_ && !from_another) {
    return failure(Problem{ProblemKind::conflict, "control-is-held", "",
                           holder_->who + " has control; send \"take\": true to take it over",
                           holder_->who});
  }
  Taken taken{random_hex(), holder_ ? holder_->move : std::nullopt};
  holder_ = Holder{who, std::move(token), std::chrono::system_clock::now()};
  key_ = taken.key;
  return taken;
}

Result<std::optional<Control::Move>> Control::give_back(const std::string& key) {
  if (auto held = check(key); !held) return failure(std::move(held.error()));
  return end();
}

std::optional<Control::Move> Control::end() {
  auto move = holder_->move;
  holder_.reset();
  key_.clear();
  return move;
}

bool Control::renew(std::chrono::milliseconds lease, Time now) {
  Move& move = *holder_->move;
  if (now - move.held_at > lease) return false;
  move.held_at = now;
  return true;
}

Result<void> Control::check(const std::string& key) const {
  if (holder_ && equal_in_constant_time(key, key_)) return {};
  return failure(Problem{
      ProblemKind::conflict, "not-in-control", "/control",
      holder_ ? holder_->who +
                    " has control, and this key is not valid: take control with POST /control "
                    "(\"take\": true)"
              : std::string("no client has control: take it with POST /control")});
}

}  // namespace armloom
