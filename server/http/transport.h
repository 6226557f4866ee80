#pragma once

#include <array>
#include <boost/beast/core/role.hpp>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "core/base/problem.h"
#include "server/http/asio.h"

namespace boost::asio::ssl {
class context;
}

namespace armloom {

struct TlsFiles;
using TlsContextPtr = std::shared_ptr<asio::ssl::context>;

// Returns the TLS settings with this certificate and key. Problem (invalid): a file cannot be read,
// or key and certificate do not match.
[[nodiscard]] Result<TlsContextPtr> tls_context(const TlsFiles& files);

// A type-erased completion handler, so that operations are compiled only once.
class Completion {
 public:
  template <class Handler>
  requires(!std::same_as<Handler, Completion>) explicit Completion(Handler handler)
      : handler_(std::make_unique<Typed<Handler>>(std::move(handler))) {}
  // Wraps the handler of an operation that reports no size.
  template <class Handler>
  static Completion of_error(Handler handler) {
    return Completion(
        [handler = std::move(handler)](ErrorCode ec, std::size_t) mutable { handler(ec); });
  }
  void operator()(ErrorCode ec, std::size_t size = 0) {
    Erased& handler = *handler_;
    handler.complete(std::move(handler_), ec, size);
  }

 private:
  struct Erased {
    virtual ~Erased() = default;
    // Frees `self` before it calls the handler, because the handler may start the next operation.
    virtual void complete(std::unique_ptr<Erased> self, ErrorCode ec, std::size_t size) = 0;
  };
  template <class Handler>
  struct Typed final : Erased {
    explicit Typed(Handler&& from) : handler(std::move(from)) {}
    void complete(std::unique_ptr<Erased> self, ErrorCode ec, std::size_t size) override {
      Handler completed = std::move(handler);
      self.reset();
      completed(ec, size);
    }
    Handler handler;
  };

  std::unique_ptr<Erased> handler_;
};

// The stream of a connection for asio and Beast, plain or through TLS. Use it on the server's
// thread only, where its handlers run. At most one read and one write may be under way.
class Transport {
 public:
  using executor_type = Executor;

  // `tls` is null for a plain connection.
  Transport(Socket socket, const TlsContextPtr& tls);
  Transport(Transport&&) noexcept;
  ~Transport();

  executor_type get_executor() noexcept { return socket().get_executor(); }
  Socket& socket();  // the socket's address does not change on a move
  // Sets the deadline of later reads and writes; when it passes, the connection is closed.
  void expires_after(std::chrono::milliseconds time);
  void expires_never();
  void cancel();  // reads and writes under way end with an error
  void close();
  // Returns the IP address of the other end, or "" if it is unknown.
  [[nodiscard]] std::string peer() const;

  // Does the TLS handshake, if any. Call it before reading. Returns false if the handshake fails or
  // takes longer than `time`.
  Awaitable<bool> shake_hands(std::chrono::milliseconds time);
  Awaitable<std::size_t> read_some(asio::mutable_buffer to, ErrorCode& ec);
  Awaitable<void> write(asio::const_buffer first, asio::const_buffer second, ErrorCode& ec);

  template <class Buffers, class Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    asio::mutable_buffer first;
    for (auto one = asio::buffer_sequence_begin(buffers);
         first.size() == 0 && one != asio::buffer_sequence_end(buffers); ++one) {
      first = *one;
    }
    return asio::async_initiate<Token, void(ErrorCode, std::size_t)>(
        [this, first](auto handler) { start_read(first, Completion(std::move(handler))); }, token);
  }
  template <class Buffers, class Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    Written from{};
    auto next = from.begin();
    for (auto one = asio::buffer_sequence_begin(buffers);
         next != from.end() && one != asio::buffer_sequence_end(buffers); ++one) {
      *next++ = *one;
    }
    return asio::async_initiate<Token, void(ErrorCode, std::size_t)>(
        [this, from](auto handler) { start_write(from, Completion(std::move(handler))); }, token);
  }

 private:
  using Written = std::array<asio::const_buffer, 16>;  // as many as asio writes at once
  friend void async_teardown(boost::beast::role_type role, Transport& transport, Completion then);

  void start_read(asio::mutable_buffer to, Completion then);
  void start_write(const Written& from, Completion then);

  struct Layers;
  std::unique_ptr<Layers> layers_;
};

// Beast calls this to end a WebSocket after its closing frames.
void async_teardown(boost::beast::role_type role, Transport& transport, Completion then);
template <class Handler>
void async_teardown(boost::beast::role_type role, Transport& transport, Handler&& handler) {
  async_teardown(role, transport, Completion::of_error(std::forward<Handler>(handler)));
}
// Beast calls this to close a connection that has timed out.
void beast_close_socket(Transport& transport);

}  // namespace armloom
