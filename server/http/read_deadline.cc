#include "server/http/read_deadline.h"

#include "server/http/transport.h"

namespace armloom {
namespace {

// Interval at which cancel() is repeated: the reader may start another read just after cancel().
constexpr std::chrono::milliseconds kAgain{50};

}  // namespace

ReadDeadline::ReadDeadline(Transport& stream, std::chrono::milliseconds time)
    : watch_(std::make_shared<Watch>(Watch{Timer(stream.get_executor()), &stream})) {
  stream.expires_never();
  wait(watch_, time);
}

ReadDeadline::~ReadDeadline() {
  watch_->stream = nullptr;
  watch_->timer.cancel();
}

void ReadDeadline::wait(const std::shared_ptr<Watch>& watch, std::chrono::milliseconds time) {
  watch->timer.expires_after(time);
  watch->timer.async_wait([watch](ErrorCode ec) {
    if (ec || watch->stream == nullptr) return;
    watch->is_over = true;
    watch->stream->cancel();
    wait(watch, kAgain);
  });
}

}  // namespace armloom
