#pragma once

#include <chrono>
#include <memory>

#include "server/http/asio.h"

namespace armloom {

class Transport;

// Cancels the stream's reads after a given time, again and again while this object lives. The
// connection stays open, so that the client can be answered.
class ReadDeadline {
 public:
  // `stream` must outlive this object. Replaces the stream's own deadline.
  ReadDeadline(Transport& stream, std::chrono::milliseconds time);
  ~ReadDeadline();
  ReadDeadline(const ReadDeadline&) = delete;
  ReadDeadline& operator=(const ReadDeadline&) = delete;

  [[nodiscard]] bool is_over() const { return watch_->is_over; }

 private:
  struct Watch {
    Timer timer;
    Transport* stream;  // null after the ReadDeadline is destroyed
    bool is_over = false;
  };
  static void wait(const std::shared_ptr<Watch>& watch, std::chrono::milliseconds time);

  std::shared_ptr<Watch> watch_;
};

}  // namespace armloom
