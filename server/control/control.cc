#include "server/control/control.h"

#include <utility>

#include "server/codec/stream_id.h"

namespace armloom {
namespace {

// In a time that does not tell how much of it fits.
bool are_equal(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |=
        static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  }
  return difference == 0;
}

}  // namespace

Result<Control::Taken> Control::take(const std::string& who, bool from_another) {
  if (holder_ && !from_another) {
    return failure(Problem{ProblemKind::conflict, "control-is-held", "",
                           holder_->who + " has control; \"take\": true takes it", holder_->who});
  }
  Taken taken{random_stream(), holder_ ? holder_->move : std::nullopt};
  holder_ = Holder{who, std::chrono::system_clock::now()};
  key_ = taken.key;
  return taken;
}

Result<std::optional<Control::Move>> Control::give_back(const std::string& key) {
  if (auto held = check(key); !held) return failure(std::move(held.error()));
  auto move = holder_->move;
  holder_.reset();
  key_.clear();
  return move;
}

Result<void> Control::check(const std::string& key) const {
  if (holder_ && are_equal(key, key_)) return {};
  return failure(Problem{ProblemKind::conflict, "not-in-control", "/control",
                         holder_ ? holder_->who + " has control, not who shows this key"
                                 : std::string("nobody has control: POST /control takes it")});
}

}  // namespace armloom
