#include "server/http/stream_session.h"

#include <utility>

namespace armloom {
namespace {

using Clock = std::chrono::steady_clock;

// What reader and writer of one stream share.
struct Session {
  Session(std::shared_ptr<StreamCarrier> on, FeedPtr of)
      : carrier(std::move(on)), feed(std::move(of)), news(carrier->executor()) {}

  std::shared_ptr<StreamCarrier> carrier;
  FeedPtr feed;
  asio::steady_timer news;  // cancelled when there is something to do
  bool closed = false;
};

asio::awaitable<void> watch(std::shared_ptr<Session> session) {
  co_await session->carrier->read_until_closed();
  session->closed = true;
  session->news.cancel();
}

Clock::time_point after(std::chrono::milliseconds pause) {
  return pause == std::chrono::milliseconds::max() ? Clock::time_point::max()
                                                   : Clock::now() + pause;
}

}  // namespace

asio::awaitable<void> carry(EventStream events, std::shared_ptr<StreamCarrier> carrier,
                            std::chrono::milliseconds keep_alive) {
  const auto session = std::make_shared<Session>(carrier, events.feed);
  events.feed->on_news([weak = std::weak_ptr(session)] {
    if (const auto still = weak.lock()) still->news.cancel();
  });
  asio::co_spawn(carrier->executor(), watch(session), asio::detached);
  ErrorCode ec;
  // Counted from the last byte sent: news that this reader does not get wakes it, too.
  auto keep_alive_at = after(keep_alive);
  while (!ec && !session->closed) {
    if (const auto farewell = session->feed->farewell()) {
      co_await carrier->say_farewell(*farewell, ec);
      break;
    }
    if (const auto message = session->feed->next()) {
      if (!message->seq && !events.frames) continue;
      co_await carrier->send(*message, ec);
      keep_alive_at = after(keep_alive);
      continue;
    }
    session->news.expires_at(keep_alive_at);
    ErrorCode woken;
    co_await session->news.async_wait(into(woken));
    if (woken) continue;
    co_await carrier->keep_alive(ec);
    keep_alive_at = after(keep_alive);
  }
  carrier->close();
}

}  // namespace armloom
