#include "server/http/session.h"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>
#include <ctime>
#include <optional>

#include "server/http/event_stream.h"
#include "server/http/framing.h"
#include "server/http/websocket_session.h"

namespace armloom {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using RequestParser = http::request_parser<http::string_body>;
using RequestMessage = http::request<http::string_body>;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[64];
  std::strftime(text, sizeof text, "%a, %d %b %Y %H:%M:%S GMT", &parts);
  return text;
}

FramingFields framing_of(const RequestMessage& message) {
  FramingFields fields;
  fields.http_1_1 = message.version() >= 11;
  for (const auto& field : message) {
    if (field.name() == http::field::host) fields.hosts.push_back(view(field.value()));
    if (field.name() == http::field::transfer_encoding) {
      fields.transfer_encodings.push_back(view(field.value()));
    }
    if (field.name() == http::field::content_length) {
      fields.content_lengths.push_back(view(field.value()));
    }
  }
  return fields;
}

// What must be refused before the body is read; the connection ends with it.
std::optional<Refusal> header_refusal(const RequestMessage& message) {
  if (const auto fault = framing_fault(framing_of(message))) {
    return Refusal{400, "bad-request", fault->detail, std::nullopt, fault->value};
  }
  const auto expect = message.find(http::field::expect);
  if (expect != message.end() && !beast::iequals(expect->value(), "100-continue")) {
    return Refusal{417, "expectation-failed", "the only Expect served is 100-continue",
                   std::nullopt, std::string(expect->value())};
  }
  return std::nullopt;
}

// Why whoever asks may only read. A browser names the page that asks: other sites may not change
// anything, nor listen. Nor may a page whose own name was made to point here; to a browser it is of
// the same origin.
std::optional<Refusal> foreign_asker(const RequestMessage& message, const HostRule& hosts) {
  const auto authority = message.find(http::field::host);
  const std::string host = authority == message.end() ? "" : host_of(view(authority->value()));
  if (authority != message.end() && !may_command(host, hosts)) {
    return Refusal{403, "foreign-host",
                   "commands may come to an IP address, to localhost and to the names given with "
                   "--allow-host, not to \"" +
                       host + "\"",
                   std::nullopt, host};
  }
  const auto origin = message.find(http::field::origin);
  if (origin == message.end()) return std::nullopt;
  if (same_origin(view(origin->value()), view(message[http::field::host]))) return std::nullopt;
  return Refusal{403, "foreign-origin", "pages of another site may not command this server",
                 std::nullopt, std::string(origin->value())};
}

Refusal refusal_of_error(ErrorCode ec) {
  if (ec == http::error::body_limit) {
    return {413, "body-too-large", "a body may have at most 8 MiB", "request body"};
  }
  if (ec == http::error::header_limit) {
    return {431, "header-too-large", "the header may have at most 16 KiB"};
  }
  return {400, "bad-request", "this is not HTTP/1.1: " + ec.message()};
}

// One connection, with what its requests share.
struct Connection {
  explicit Connection(tcp::socket socket) : stream(std::move(socket)) {}
  beast::tcp_stream stream;
  beast::flat_buffer buffer;
};

asio::awaitable<void> send(Connection& connection, Response response, unsigned version,
                           bool keep_alive, bool without_body, ErrorCode& ec) {
  http::response<http::string_body> message;
  message.version(version);
  message.result(static_cast<unsigned>(response.status));
  message.set(http::field::server, "armloom");
  message.set(http::field::date, http_date());
  message.set("X-Content-Type-Options", "nosniff");
  for (const auto& [name, value] : response.headers) message.set(name, value);
  if (!response.content_type.empty()) message.set(http::field::content_type, response.content_type);
  message.keep_alive(keep_alive);
  if (response.status != 204) message.content_length(response.body.size());
  if (!without_body) message.body() = std::move(response.body);
  connection.stream.expires_after(kWriteTime);
  co_await http::async_write(connection.stream, message, into(ec));
}

// Ends a connection so that the peer can still read the answer: closing a socket with unread input
// would reset it.
asio::awaitable<void> linger(Connection& connection) {
  static constexpr std::size_t kDrainMax = 2 * kBodyMax;
  ErrorCode ec;
  connection.stream.socket().shutdown(tcp::socket::shutdown_send, ec);
  connection.stream.expires_after(std::chrono::seconds(2));
  std::vector<char> sink(64 * 1024);
  for (std::size_t drained = 0; !ec && drained < kDrainMax;) {
    drained += co_await connection.stream.async_read_some(asio::buffer(sink), into(ec));
  }
}

// Hands the request to the site and waits for its answer.
asio::awaitable<Response> answer(const Site& site, const Request& request) {
  struct Pending {
    explicit Pending(const asio::any_io_executor& executor)
        : arrived(executor, std::chrono::steady_clock::now() + kWriteTime) {}
    asio::steady_timer arrived;
    std::optional<Response> response;
  };
  const auto pending = std::make_shared<Pending>(co_await asio::this_coro::executor);
  site.handle(request, [pending](Response response) {
    pending->response = std::move(response);
    pending->arrived.cancel();
  });
  ErrorCode ignored;
  if (!pending->response) co_await pending->arrived.async_wait(into(ignored));
  if (pending->response) co_return std::move(*pending->response);
  co_return site.refuse({503, "no-answer", "the server did not answer in time"});
}

std::optional<std::string> field(const RequestMessage& message, beast::string_view name) {
  const auto it = message.find(name);
  return it == message.end() ? std::nullopt : std::optional(std::string(it->value()));
}

asio::awaitable<Response> respond_to(const Site& site, RequestMessage& message, bool upgrade) {
  auto target = parse_target(view(message.target()));
  if (!target) co_return site.refuse(refusal_of(400, target.error().front()));
  Request request;
  request.method =
      message.method() == http::verb::head ? "GET" : std::string(message.method_string());
  request.target = std::move(*target);
  request.content_type = field(message, "Content-Type");
  request.content_encoding = field(message, "Content-Encoding");
  request.last_event_id = field(message, "Last-Event-ID");
  request.foreign = foreign_asker(message, site.hosts);
  request.upgrade = upgrade;
  request.body = std::move(message.body());
  co_return co_await answer(site, request);
}

// Waits for the next request's first bytes, then reads its header; the time for the header does not
// begin before.
asio::awaitable<void> read_header(Connection& connection, RequestParser& parser,
                                  std::chrono::milliseconds read_time, ErrorCode& ec) {
  if (connection.buffer.size() == 0) {
    connection.stream.expires_after(kIdleTime);
    const std::size_t size =
        co_await connection.stream.async_read_some(connection.buffer.prepare(4096), into(ec));
    connection.buffer.commit(size);
    if (ec) co_return;
  }
  connection.stream.expires_after(read_time);
  co_await http::async_read_header(connection.stream, connection.buffer, parser, into(ec));
}

asio::awaitable<void> read_body(Connection& connection, RequestParser& parser,
                                std::chrono::milliseconds read_time, ErrorCode& ec) {
  connection.stream.expires_after(read_time);
  if (parser.get().count(http::field::expect) > 0 && !parser.is_done()) {
    http::response<http::empty_body> go_on(http::status::continue_, 11);
    co_await http::async_write(connection.stream, go_on, into(ec));
    if (ec) co_return;
  }
  co_await http::async_read(connection.stream, connection.buffer, parser, into(ec));
}

bool is_silent_end(ErrorCode ec) {
  return ec.category() != http::make_error_code(http::error::end_of_stream).category() ||
         ec == http::error::end_of_stream || ec == http::error::partial_message;
}

// Whether the request, its header read, wants to go on as a WebSocket: it has no body.
bool is_handshake(const RequestParser& parser) {
  return beast::websocket::is_upgrade(parser.get()) && !parser.get().has_content_length() &&
         parser.is_done();
}

asio::awaitable<void> refuse(Connection& connection, Response why) {
  ErrorCode ec;
  co_await send(connection, std::move(why), 11, false, false, ec);
  if (!ec) co_await linger(connection);
}

// One request and its answer. Whether another may follow on the connection.
asio::awaitable<bool> serve_request(Connection& connection, const Site& site) {
  ErrorCode ec;
  RequestParser parser;
  parser.body_limit(kBodyMax);
  parser.header_limit(static_cast<std::uint32_t>(kHeaderMax));
  std::optional<Refusal> refusal;
  co_await read_header(connection, parser, site.read_time, ec);
  if (!ec) refusal = header_refusal(parser.get());
  const bool upgrade = !ec && !refusal && is_handshake(parser);
  if (!ec && !refusal && !upgrade) co_await read_body(connection, parser, site.read_time, ec);
  if (ec && is_silent_end(ec)) co_return false;
  if (ec) refusal = refusal_of_error(ec);
  if (refusal) {
    co_await refuse(connection, site.refuse(*refusal));
    co_return false;
  }
  RequestMessage message = parser.release();
  const bool keep_alive = message.keep_alive() && !upgrade;
  const bool without_body = message.method() == http::verb::head;
  const unsigned version = message.version();
  Response response = co_await respond_to(site, message, upgrade);
  if (response.events && response.status == 101) {
    co_await serve_websocket(std::move(connection.stream), std::move(message),
                             std::move(*response.events));
    co_return false;
  }
  if (response.events && !without_body) {
    co_await serve_event_stream(std::move(connection.stream), std::move(*response.events), site);
    co_return false;
  }
  co_await send(connection, std::move(response), version, keep_alive, without_body, ec);
  if (!ec && !keep_alive) co_await linger(connection);
  co_return !ec && keep_alive;
}

}  // namespace

asio::awaitable<void> serve_connection(tcp::socket socket, const Site& site) {
  ErrorCode ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  Connection connection(std::move(socket));
  while (co_await serve_request(connection, site)) {
  }
}

asio::awaitable<void> refuse_connection(tcp::socket socket, Response why) {
  Connection connection(std::move(socket));
  co_await refuse(connection, std::move(why));
}

}  // namespace armloom
