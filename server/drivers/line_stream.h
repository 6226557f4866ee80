#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>

#include "core/model/endpoint.h"

namespace armloom {

// Owns a file descriptor.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor();
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

// Return a non-blocking socket. Problem (unavailable): without a pointer.
// Waits at most two seconds, or until a stop is requested. (The lookup of a host name may block
// longer.)
[[nodiscard]] Result<Descriptor> connect_to(const Endpoint& endpoint, const std::stop_token& stop);
// Replaces the file of a Unix socket whose process has ended.
[[nodiscard]] Result<Descriptor> listen_on(const Endpoint& endpoint);
// Returns the endpoint with the port that the system chose for port 0.
[[nodiscard]] Endpoint bound_endpoint(const Endpoint& endpoint, const Descriptor& listening);
// Returns a connection that has arrived, or a closed descriptor if there is none.
[[nodiscard]] Descriptor accept_from(const Descriptor& listening);

// Sends and receives lines on a non-blocking socket. Never blocks. Not thread-safe.
class LineStream {
 public:
  // Longest line that is accepted, and most bytes that wait to be sent.
  LineStream(Descriptor socket, std::size_t line_max, std::size_t unsent_max)
      : socket_(std::move(socket)), line_max_(line_max), unsent_max_(unsent_max) {}

  [[nodiscard]] int fd() const { return socket_.get(); }
  // Reads what has arrived. Lines that arrived before the end of the stream can still be taken.
  void receive();
  [[nodiscard]] std::optional<std::string> next_line();
  // Appends '\n'.
  void send(std::string_view line);
  void flush();
  [[nodiscard]] bool has_unsent() const { return sent_ < out_.size(); }
  // Why the stream has ended: the peer has closed it, or an error; nullopt while it is open.
  [[nodiscard]] const std::optional<std::string>& end() const { return end_; }

 private:
  void fail(std::string why);

  Descriptor socket_;
  std::size_t line_max_;
  std::size_t unsent_max_;
  std::string in_;
  std::size_t taken_ = 0;     // of in_
  std::size_t searched_ = 0;  // of in_: no line ends before
  std::string out_;
  std::size_t sent_ = 0;  // of out_
  std::optional<std::string> end_;
};

}  // namespace armloom
