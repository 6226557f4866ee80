#include "server/http/connection.h"

#include <algorithm>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
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

std::string head_of(const Connection& connection, const Response& response, Delivery delivery,
                    std::uintmax_t body_size) {
  http::response<http::empty_body> message;
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
  if (response.status != 204 && response.status != 304) message.content_length(body_size);
  std::string text = delivery.version == 10 ? "HTTP/1.0 " : "HTTP/1.1 ";
  const auto add = [&text](beast::string_view part) { text.append(part.data(), part.size()); };
  add(std::to_string(response.status));
  add(" ");
  add(message.reason());
  add("\r\n");
  for (const auto& field : message) {
    add(field.name_string());
    add(": ");
    add(field.value());
    add("\r\n");
  }
  return text + "\r\n";
}

}  // namespace

Awaitable<void> send(Connection& connection, Response response, Delivery delivery, ErrorCode& ec) {
  const std::string& body = response.shared ? *response.shared : response.body;
  const std::uintmax_t size = response.pieces ? response.pieces->size : body.size();
  const std::string head = head_of(connection, response, delivery, size);
  connection.stream.expires_after(kWriteTime);
  co_await connection.stream.write(
      asio::buffer(head), delivery.without_body ? asio::const_buffer() : asio::buffer(body), ec);
  if (ec || !response.pieces || delivery.without_body) co_return;
  co_await send_pieces(connection.stream, *response.pieces, kWriteTime, ec);
}

// Discards unread input before the socket is closed. Otherwise, closing would reset the connection,
// and the client could lose the response.
Awaitable<void> linger(Connection& connection) {
  static constexpr std::size_t kDrainMax = 2 * kBodyMax;
  ErrorCode ec;
  connection.stream.socket().shutdown(Socket::shutdown_send, ec);
  connection.stream.expires_after(std::chrono::seconds(2));
  connection.buffer.clear();
  for (std::size_t drained = 0; !ec && drained < kDrainMax;) {
    drained += co_await connection.stream.read_some(connection.buffer.prepare(kBufferMax), ec);
  }
}

Awaitable<void> refuse(Connection& connection, Response why) {
  ErrorCode ec;
  co_await send(connection, std::move(why), {}, ec);
  if (!ec) co_await linger(connection);
}

}  // namespace armloom
