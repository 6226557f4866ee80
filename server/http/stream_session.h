#pragma once

#include <chrono>
#include <memory>

#include "server/http/asio.h"
#include "server/http/message.h"

namespace armloom {

// What carries a subscription to its reader: a WebSocket, or Server-Sent Events. On the server's
// thread.
class StreamCarrier {
 public:
  virtual ~StreamCarrier() = default;
  [[nodiscard]] virtual Executor executor() = 0;
  // Reads over what the reader sends, until it has gone.
  virtual Awaitable<void> read_until_closed() = 0;
  virtual Awaitable<void> send(const Subscription::Message& message, ErrorCode& ec) = 0;
  // Nothing was sent for the time that carry() was given.
  virtual Awaitable<void> keep_alive(ErrorCode& ec) = 0;
  virtual Awaitable<void> say_why(const CloseReason& reason, ErrorCode& ec) = 0;
  virtual void close() = 0;
  // At once, whatever is under way, which then ends with an error.
  virtual void cut() = 0;
};

struct StreamTimes {
  std::chrono::milliseconds send;  // that one message may take; then the reader is cut off
  // Without a message: keep_alive(). max(): the carrier sees for itself whether its reader is
  // there.
  std::chrono::milliseconds keep_alive;
};

// Sends what the subscription has until either side ends it. A reader that lets a message wait for
// longer than it may, or falls farther behind than the subscription holds, is cut off, whatever it
// sends itself.
Awaitable<void> carry(EventStream events, std::shared_ptr<StreamCarrier> carrier,
                      StreamTimes times);

}  // namespace armloom
