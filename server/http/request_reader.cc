#include "server/http/request_reader.h"

#include <boost/beast/core/read_size.hpp>

#include "server/http/framing.h"
#include "server/http/read_deadline.h"
#include "server/http/request_head.h"
#include "server/http/session.h"

namespace armloom {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::size_t kEmptyLinesMax = 4;  // before a request line

std::string_view held(const Connection& connection) {
  const auto data = connection.buffer.data();
  return {static_cast<const char*>(data.data()), data.size()};
}

NoRequest too_late(const char* what) {
  return {Refusal{408, "request-timeout", std::string("the ") + what + " did not arrive in time"}};
}

Refusal bad_request(std::string detail) { return {400, "bad-request", std::move(detail)}; }

// Returns the answer to an error of the parser or the socket. `buffered`, the input not yet parsed,
// shows which limit was exceeded.
NoRequest stopped_by(ErrorCode ec, std::string_view buffered) {
  if (ec == boost::system::errc::not_enough_memory) {
    return {Refusal{503,
                    "server-busy",
                    "too many large bodies are being read at once",
                    "request body",
                    std::nullopt,
                    {{"Retry-After", "1"}}}};
  }
  const auto own = http::make_error_code(http::error::end_of_stream);
  if (ec.category() != own.category() || ec == own || ec == http::error::partial_message) return {};
  if (ec == http::error::body_limit) {
    return {Refusal{413, "body-too-large", "a body may have at most 8 MiB", "request body"}};
  }
  if (ec == http::error::header_limit) {
    return {Refusal{431, "header-too-large", "the header may have at most 16 KiB"}};
  }
  // A chunk's line begins with the CRLF that ends the previous chunk.
  const std::size_t line = buffered.starts_with("\r\n") ? 2 : 0;
  const bool in_chunk_line = buffered.find("\r\n", line) == buffered.npos;
  if (ec == http::error::bad_chunk_extension ||
      (ec == http::error::buffer_overflow && in_chunk_line)) {
    return {bad_request(
        "a chunk's size is not a hexadecimal number, or its chunk extensions are invalid or exceed "
        "16 KiB in total")};
  }
  if (ec == http::error::buffer_overflow) {
    return {Refusal{431, "header-too-large", "the trailers may have at most 16 KiB"}};
  }
  return {bad_request("the request is not HTTP/1.1: " + ec.message())};
}

Awaitable<void> read_some(Connection& connection, std::size_t max, ErrorCode& ec) {
  const std::size_t size = co_await connection.stream.read_some(connection.buffer.prepare(max), ec);
  connection.buffer.commit(size);
}

// Reads and parses until `is_read` returns true.
Awaitable<void> parse(Connection& connection, RequestParser& parser,
                      bool (RequestParser::*is_read)() const, ErrorCode& ec) {
  while (!ec && !(parser.*is_read)()) {
    if (connection.buffer.size() > 0) {
      connection.buffer.consume(parser.put(connection.buffer.data(), ec));
      if (ec != http::error::need_more) continue;
    }
    const std::size_t max = beast::read_size(connection.buffer, 64 * 1024);
    if (max == 0) {
      ec = http::error::buffer_overflow;
      co_return;
    }
    co_await read_some(connection, max, ec);
  }
}

// Reads until the first line is complete or too long.
Awaitable<std::optional<NoRequest>> read_first_line(Connection& connection) {
  ErrorCode ec;
  for (std::size_t empty = 0;;) {
    while (held(connection).starts_with("\r\n")) {
      connection.buffer.consume(2);
      if (++empty > kEmptyLinesMax) {
        co_return NoRequest{bad_request("too many empty lines before a request")};
      }
    }
    const std::string_view text = held(connection);
    if (const std::size_t end = text.find("\r\n"); end != text.npos) {
      auto refusal = settle_version(static_cast<char*>(connection.buffer.data().data()), end);
      co_return refusal ? std::optional(NoRequest{std::move(refusal)}) : std::nullopt;
    }
    if (text.size() >= kHeaderMax) {
      co_return NoRequest{
          Refusal{414, "target-too-long", "a request line may have at most 16 KiB"}};
    }
    // The parser gets the line only when it is complete, because settle_version() may change it.
    co_await read_some(connection, 4096, ec);
    if (ec) co_return NoRequest{};
  }
}

// Reads until the header is complete or too long, and refuses obs-fold: the parser would unfold the
// field.
Awaitable<std::optional<NoRequest>> read_unfolded(Connection& connection) {
  ErrorCode ec;
  for (std::size_t searched = 0;;) {
    const std::string_view text = held(connection);
    const std::size_t end = text.find("\r\n\r\n", searched);
    if (end != text.npos || text.size() >= kHeaderMax) {
      auto refusal = folded_field(text.substr(0, end));
      co_return refusal ? std::optional(NoRequest{std::move(refusal)}) : std::nullopt;
    }
    searched = text.size() < 3 ? 0 : text.size() - 3;
    co_await read_some(connection, 4096, ec);
    if (ec) co_return NoRequest{};
  }
}

}  // namespace

Awaitable<std::optional<NoRequest>> read_header(Connection& connection, RequestParser& parser,
                                                ReadTimes times) {
  parser.body_limit(kBodyMax);
  parser.header_limit(static_cast<std::uint32_t>(kHeaderMax));
  ErrorCode ec;
  if (connection.buffer.size() == 0) {
    const ReadDeadline deadline(connection.stream, times.idle);
    co_await read_some(connection, 4096, ec);
    if (ec) co_return NoRequest{};
  }
  const ReadDeadline deadline(connection.stream, times.read);
  auto none = co_await read_first_line(connection);
  if (!none) none = co_await read_unfolded(connection);
  if (!none) {
    co_await parse(connection, parser, &RequestParser::is_header_done, ec);
    if (ec) none = stopped_by(ec, "");
  }
  co_return deadline.is_over() ? std::optional(too_late("header")) : none;
}

Awaitable<std::optional<NoRequest>> read_body(Connection& connection, RequestParser& parser,
                                              std::chrono::milliseconds read_time,
                                              bool ask_for_it) {
  if (parser.is_done()) co_return std::nullopt;
  const ReadDeadline deadline(connection.stream, read_time);
  ErrorCode ec;
  if (ask_for_it) {
    static constexpr std::string_view kGoOn = "HTTP/1.1 100 Continue\r\n\r\n";
    co_await connection.stream.write(asio::buffer(kGoOn), {}, ec);
    if (ec) co_return NoRequest{};
  }
  std::size_t extensions = 0;
  auto count = [&extensions](std::uint64_t, beast::string_view extension, ErrorCode& over) {
    extensions += extension.size();
    if (extensions > kHeaderMax) over = http::error::bad_chunk_extension;
  };
  parser.on_chunk_header(count);
  parser.get().body().charge = MemoryBudget::Charge(connection.memory);
  co_await parse(connection, parser, &RequestParser::is_done, ec);
  if (deadline.is_over()) co_return too_late("body");
  co_return ec ? std::optional(stopped_by(ec, held(connection))) : std::nullopt;
}

}  // namespace armloom
