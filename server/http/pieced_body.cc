#include "server/http/pieced_body.h"

#include <algorithm>
#include <boost/asio/error.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace armloom {
namespace {

Awaitable<std::optional<std::string>> read_piece(const PiecedBody& body, std::uintmax_t from,
                                                 std::size_t count) {
  struct Pending {
    explicit Pending(const Executor& executor)
        : arrived(executor, std::chrono::steady_clock::time_point::max()) {}
    Timer arrived;
    bool has_arrived = false;
    std::optional<std::string> bytes = {};
  };
  const auto pending = std::make_shared<Pending>(co_await asio::this_coro::executor);
  body.read(from, count, [pending](std::optional<std::string>&& bytes) {
    pending->bytes = std::move(bytes);
    pending->has_arrived = true;
    pending->arrived.cancel();
  });
  ErrorCode ignored;
  if (!pending->has_arrived) co_await pending->arrived.async_wait(into(ignored));
  co_return std::move(pending->bytes);
}

}  // namespace

Awaitable<void> send_pieces(Transport& stream, const PiecedBody& body,
                            std::chrono::milliseconds time, ErrorCode& ec) {
  for (std::uintmax_t sent = 0; !ec && sent < body.size;) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uintmax_t>(kPieceSize, body.size - sent));
    const auto piece = co_await read_piece(body, sent, count);
    if (!piece) {
      ec = asio::error::eof;
      break;
    }
    stream.expires_after(time);
    co_await stream.write(asio::buffer(*piece), {}, ec);
    sent += piece->size();
  }
}

}  // namespace armloom
