#pragma once

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "core/base/problem.h"
#include "server/http/asio.h"

namespace armloom {

struct TlsFiles;
using TlsContextPtr = std::shared_ptr<asio::ssl::context>;

// What connections are encrypted with. Problem (invalid): a file cannot be read, or they do not
// fit.
[[nodiscard]] Result<TlsContextPtr> tls_context(const TlsFiles& files);

// The bytes of a connection, as they are or through TLS; a stream to asio and Beast. Its deadlines
// are those of the TCP stream below.
class Transport {
 public:
  using next_layer_type = boost::beast::tcp_stream;
  using executor_type = next_layer_type::executor_type;

  // `tls`: null: without.
  Transport(tcp::socket socket, const TlsContextPtr& tls);

  executor_type get_executor() noexcept { return tcp_->get_executor(); }
  next_layer_type& next_layer() { return *tcp_; }
  const next_layer_type& next_layer() const { return *tcp_; }
  tcp::socket& socket() { return tcp_->socket(); }
  template <class Duration>
  void expires_after(Duration duration) {
    tcp_->expires_after(duration);
  }
  void expires_never() { tcp_->expires_never(); }
  void cancel() { tcp_->cancel(); }  // what is under way ends with an error
  void close() { tcp_->close(); }
  // Where the other end is: an IP address.
  [[nodiscard]] std::string peer() const;

  // Before anything else. False: it did not come about in time.
  asio::awaitable<bool> shake_hands(std::chrono::milliseconds time);

  template <class Buffers, class Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    return tls_ ? tls_->async_read_some(buffers, std::forward<Token>(token))
                : tcp_->async_read_some(buffers, std::forward<Token>(token));
  }
  template <class Buffers, class Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    return tls_ ? tls_->async_write_some(buffers, std::forward<Token>(token))
                : tcp_->async_write_some(buffers, std::forward<Token>(token));
  }

 private:
  std::unique_ptr<next_layer_type> tcp_;  // stays where it is when this is moved
  std::unique_ptr<asio::ssl::stream<next_layer_type&>> tls_;
};

// How Beast ends a WebSocket: its closing frames have said all.
void teardown(boost::beast::role_type role, Transport& transport, ErrorCode& ec);
template <class Handler>
void async_teardown(boost::beast::role_type role, Transport& transport, Handler&& handler) {
  using boost::beast::websocket::async_teardown;
  async_teardown(role, transport.next_layer(), std::forward<Handler>(handler));
}

}  // namespace armloom
