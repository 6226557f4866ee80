#include "server/http/stream_session.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace armloom {
namespace {

using Clock = std::chrono::steady_clock;

// Time limit for the current message of a subscriber that is too slow. Then the close reason is
// sent.
constexpr std::chrono::seconds kLastMessage{2};
// Interval at which an idle subscriber's permission is checked.
constexpr std::chrono::seconds kLooksAgain{1};

// State shared by the reading and the writing coroutine of one stream.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(std::shared_ptr<StreamCarrier> on, SubscriptionPtr of)
      : carrier(std::move(on)),
        subscription(std::move(of)),
        news(carrier->executor()),
        deadline_(carrier->executor()) {}

  // Starts the deadline of a message.
  void begin_sending(std::chrono::milliseconds time) {
    sending_ = true;
    cut_at_ = Clock::now() + time;
    watch_deadline();
  }
  void end_sending() { sending_ = false; }
  void look_at_news() {
    news.cancel();
    if (!sending_ || hurried_) return;
    const auto reason = subscription->close_reason();
    hurried_ = reason && reason->why == CloseReason::Why::too_slow;
    if (!hurried_) return;
    cut_at_ = std::min(cut_at_, Clock::now() + kLastMessage);
    watch_deadline();
  }

  std::shared_ptr<StreamCarrier> carrier;
  SubscriptionPtr subscription;
  Timer news;  // canceled when there is something to do
  bool closed = false;

 private:
  // Does not restart the timer for each message: with thousands of subscribers, this cost more than
  // sending. When the timer expires, it checks the deadline of the current message.
  void watch_deadline() {
    if (is_watched_ && deadline_.expiry() <= cut_at_) return;
    is_watched_ = true;
    deadline_.expires_at(cut_at_);
    deadline_.async_wait([self = weak_from_this()](ErrorCode ec) {
      const auto session = self.lock();
      if (ec || !session) return;  // reset, or gone
      session->is_watched_ = false;
      if (!session->sending_) return;
      if (Clock::now() < session->cut_at_) return session->watch_deadline();
      session->carrier->cut();
    });
  }

  Timer deadline_;
  Clock::time_point cut_at_{};  // of the current message
  bool is_watched_ = false;
  bool sending_ = false;
  bool hurried_ = false;
};

Awaitable<void> watch(std::shared_ptr<Session> session) {
  co_await session->carrier->read_until_closed();
  session->closed = true;
  session->news.cancel();
}

Clock::time_point after(std::chrono::milliseconds pause) {
  return pause == std::chrono::milliseconds::max() ? Clock::time_point::max()
                                                   : Clock::now() + pause;
}

}  // namespace

Awaitable<void> carry(EventStream events, std::shared_ptr<StreamCarrier> carrier,
                      StreamTimes times) {
  const auto session = std::make_shared<Session>(carrier, events.subscription);
  events.subscription->on_news([weak = std::weak_ptr(session)] {
    if (const auto still = weak.lock()) still->look_at_news();
  });
  spawn(carrier->executor(), watch(session));
  ErrorCode ec;
  const auto is_permitted = [&events] { return !events.permitted || events.permitted(); };
  // Counted from the last message sent: a skipped frame wakes this loop, too, but sends nothing.
  auto keep_alive_at = after(times.keep_alive);
  while (!ec && !session->closed) {
    auto reason = session->subscription->close_reason();
    if (!reason && !is_permitted()) {
      reason = {CloseReason::Why::not_permitted, "the token was revoked"};
    }
    if (reason) {
      session->begin_sending(times.send);
      co_await carrier->say_why(*reason, ec);
      session->end_sending();
      break;
    }
    if (const auto message = session->subscription->next()) {
      if (!message->seq && !events.frames) continue;
      session->begin_sending(times.send);
      co_await carrier->send(*message, ec);
      session->end_sending();
      keep_alive_at = after(times.keep_alive);
      continue;
    }
    const auto looks_again =
        events.permitted ? Clock::now() + kLooksAgain : Clock::time_point::max();
    session->news.expires_at(std::min(keep_alive_at, looks_again));
    ErrorCode woken;
    co_await session->news.async_wait(into(woken));
    if (woken || looks_again < keep_alive_at) continue;
    session->begin_sending(times.send);
    co_await carrier->keep_alive(ec);
    session->end_sending();
    keep_alive_at = after(times.keep_alive);
  }
  carrier->close();
}

}  // namespace armloom
