#pragma once

#include <chrono>
#include <memory>

#include "server/http/asio.h"
#include "server/http/message.h"

namespace armloom {

// Carries a subscription to its subscriber: a WebSocket or Server-Sent Events. Use on the server's
// thread.
class StreamCarrier {
 public:
  virtual ~StreamCarrier() = default;
  [[nodiscard]] virtual Executor executor() = 0;
  // Discards what the subscriber sends, until it disconnects.
  virtual Awaitable<void> read_until_closed() = 0;
  virtual Awaitable<void> send(const Subscription::Message& message, ErrorCode& ec) = 0;
  // Called after a silence of StreamTimes::keep_alive.
  virtual Awaitable<void> keep_alive(ErrorCode& ec) = 0;
  virtual Awaitable<void> say_why(const CloseReason& reason, ErrorCode& ec) = 0;
  virtual void close() = 0;
  // Closes at once. Operations under way end with an error.
  virtual void cut() = 0;
};

struct StreamTimes {
  std::chrono::milliseconds send;  // for one message; then the subscriber is cut off
  // Silence before keep_alive(). max() if the carrier itself checks the connection.
  std::chrono::milliseconds keep_alive;
};

// Sends the subscription's messages until either side ends it. Cuts off a subscriber that takes too
// long for a message, or falls too far behind.
Awaitable<void> carry(EventStream events, std::shared_ptr<StreamCarrier> carrier,
                      StreamTimes times);

}  // namespace armloom
