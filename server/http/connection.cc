#include "server/http/connection.h"

#include <algorithm>
#include <boost/beast/core/span.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <ctime>

#include "server/http/pieced_body.h"
#include "server/http/request_id.h"
#include "server/http/security_headers.h"
#include "server/http/session.h"

namespace armloom {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[64];
  std::strftime(text, sizeof text, "%a, %d %b %Y %H:%M:%S GMT", &parts);
  return text;
}

beast::string_view view(std::string_view text) { return {text.data(), text.size()}; }

}  // namespace

asio::awaitable<void> send(Connection& connection, Response response, Delivery delivery,
                           ErrorCode& ec) {
  http::response<http::span_body<const char>> message;
  message.version(delivery.version);
  message.result(static_cast<unsigned>(response.status));
  message.set(http::field::server, "armloom");
  message.set(http::field::date, http_date());
  for (const auto& [name, value] : kSecurityHeaders) message.set(view(name), view(value));
  message.set("Content-Security-Policy", view(kNoPagePolicy));
  if (!connection.request_id.empty()) message.set(view(kRequestIdField), connection.request_id);
  for (const auto& [name, value] : response.headers) message.set(name, value);
  if (!response.content_type.empty()) message.set(http::field::content_type, response.content_type);
  message.keep_alive(delivery.keep_alive);
  const std::string& body = response.shared ? *response.shared : response.body;
  const std::uintmax_t size = response.pieces ? response.pieces->size : body.size();
  if (response.status != 204 && response.status != 304) message.content_length(size);
  if (!delivery.without_body) message.body() = {body.data(), body.size()};
  connection.stream.expires_after(kWriteTime);
  co_await http::async_write(connection.stream, message, into(ec));
  if (ec || !response.pieces || delivery.without_body) co_return;
  co_await send_pieces(connection.stream, *response.pieces, kWriteTime, ec);
}

// Closing a socket with unread input would reset it.
asio::awaitable<void> linger(Connection& connection) {
  static constexpr std::size_t kDrainMax = 2 * kBodyMax;
  ErrorCode ec;
  connection.stream.socket().shutdown(tcp::socket::shutdown_send, ec);
  connection.stream.expires_after(std::chrono::seconds(2));
  connection.buffer.clear();
  for (std::size_t drained = 0; !ec && drained < kDrainMax;) {
    drained +=
        co_await connection.stream.async_read_some(connection.buffer.prepare(kBufferMax), into(ec));
  }
}

asio::awaitable<void> refuse(Connection& connection, Response why) {
  ErrorCode ec;
  co_await send(connection, std::move(why), {}, ec);
  if (!ec) co_await linger(connection);
}

}  // namespace armloom
