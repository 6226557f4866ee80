#pragma once

#include <chrono>
#include <memory>

#include "server/http/asio.h"

namespace armloom {

class Transport;

// As long as this lives, what is read of a connection has to come in time. When it has not, reading
// is ended, again and again; the connection goes on, so that its peer can be told.
class ReadDeadline {
 public:
  // `stream` outlives it. There is no other deadline on it meanwhile.
  ReadDeadline(Transport& stream, std::chrono::milliseconds time);
  ~ReadDeadline();
  ReadDeadline(const ReadDeadline&) = delete;
  ReadDeadline& operator=(const ReadDeadline&) = delete;

  [[nodiscard]] bool is_over() const { return watch_->is_over; }

 private:
  struct Watch {
    Timer timer;
    Transport* stream;  // null: nobody reads any more
    bool is_over = false;
  };
  static void wait(const std::shared_ptr<Watch>& watch, std::chrono::milliseconds time);

  std::shared_ptr<Watch> watch_;
};

}  // namespace armloom
