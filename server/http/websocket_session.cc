#include "server/http/websocket_session.h"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "server/http/request_id.h"
#include "server/http/stream_session.h"

namespace armloom {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::chrono::seconds kIdle{30};  // then a ping is sent; disconnects if unanswered
constexpr std::size_t kMessageMax = 4096;  // bytes of a client's message

constexpr std::uint16_t kCloseCodeMax = 4999;

websocket::close_code code_of(CloseReason::Why why) {
  switch (why) {
    case CloseReason::Why::too_slow:
      return websocket::close_code::try_again_later;
    case CloseReason::Why::not_permitted:
      return websocket::close_code::policy_error;
    case CloseReason::Why::server_ends:
      break;
  }
  return websocket::close_code::going_away;
}

class WebSocket final : public StreamCarrier, public std::enable_shared_from_this<WebSocket> {
 public:
  WebSocket(Transport stream, std::string request_id, int send_buffer)
      : socket_(std::move(stream)) {
    ErrorCode ignored;
    socket_.next_layer().expires_never();
    socket_.next_layer().socket().set_option(asio::socket_base::send_buffer_size(send_buffer),
                                             ignored);
    socket_.set_option(websocket::stream_base::timeout{std::chrono::seconds(10), kIdle, true});
    socket_.set_option(websocket::stream_base::decorator(
        [id = std::move(request_id)](websocket::response_type& answer) {
          answer.set(kRequestIdField.data(), id);
        }));
    socket_.read_message_max(kMessageMax);
    socket_.auto_fragment(false);
    socket_.text(true);
  }

  template <class Upgrade>
  Awaitable<void> accept(const Upgrade& upgrade, ErrorCode& ec) {
    socket_.control_callback([this](websocket::frame_type kind, beast::string_view) {
      if (kind == websocket::frame_type::close) answer_close();
    });
    co_await socket_.async_accept(upgrade, into(ec));
  }

  // Uses one handler type, so that Beast's operation is compiled once.
  template <class Token>
  auto start_close(const websocket::close_reason& reason, Token&& token) {
    return asio::async_initiate<Token, void(ErrorCode)>(
        [this, reason](auto handler) {
          socket_.async_close(reason, Completion::of_error(std::move(handler)));
        },
        token);
  }

  Executor executor() override { return socket_.get_executor(); }
  Awaitable<void> read_until_closed() override {
    beast::flat_buffer buffer;
    ErrorCode ec;
    while (!ec) {
      co_await socket_.async_read(buffer, into(ec));
      buffer.clear();
    }
  }
  Awaitable<void> send(const Subscription::Message& message, ErrorCode& ec) override {
    co_await socket_.async_write(asio::buffer(*message.text), into(ec));
  }
  Awaitable<void> keep_alive(ErrorCode&) override { co_return; }  // pings do it
  Awaitable<void> say_why(const CloseReason& reason, ErrorCode& ec) override {
    const auto code = code_of(reason.why);
    const websocket::close_reason said(code, reason.text.substr(0, 120));
    co_await start_close(said, into(ec));
  }
  void close() override {}  // done by the closing handshake or the timeout
  void cut() override { socket_.next_layer().close(); }

 private:
  // Beast echoes close codes and rejects reserved codes (RFC 6455, 7.4), but accepts codes beyond
  // the last valid code. For these, closes with protocol_error before Beast answers.
  void answer_close() {
    if (socket_.reason().code <= kCloseCodeMax) return;
    start_close(websocket::close_code::protocol_error, [self = shared_from_this()](ErrorCode) {});
  }

  websocket::stream<Transport, false> socket_;  // false: messages are not compressed
};

}  // namespace

Awaitable<void> serve_websocket(Transport stream, RequestHeader upgrade, std::string request_id,
                                EventStream events, const Site& site) {
  const auto carrier =
      std::make_shared<WebSocket>(std::move(stream), std::move(request_id), site.send_buffer);
  const beast::http::request<beast::http::empty_body> request(std::move(upgrade));
  ErrorCode ec;
  co_await carrier->accept(request, ec);
  const StreamTimes times{site.send_time, std::chrono::milliseconds::max()};
  if (!ec) co_await carry(std::move(events), carrier, times);
}

}  // namespace armloom
