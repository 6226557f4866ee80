#include "server/http/websocket_session.h"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <chrono>
#include <memory>

namespace armloom {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::chrono::seconds kIdle{
    30};  // then the peer is pinged, and dropped if it stays silent
constexpr std::size_t kMessageMax = 4096;  // that a client may send
constexpr int kSendBuffer = 128 * 1024;    // bounds how old a pose can be when it arrives

// Reader and writer of one socket, both on the server's thread.
struct Link {
  explicit Link(beast::tcp_stream stream)
      : socket(std::move(stream)), news(socket.get_executor()) {}

  websocket::stream<beast::tcp_stream> socket;
  asio::steady_timer news;  // cancelled when there is something to do
  FeedPtr feed;
  bool closed = false;
};
using LinkPtr = std::shared_ptr<Link>;

asio::awaitable<void> read_until_closed(LinkPtr link) {
  beast::flat_buffer buffer;
  ErrorCode ec;
  while (!ec) {
    co_await link->socket.async_read(buffer, into(ec));
    buffer.clear();
  }
  link->closed = true;
  link->news.cancel();
}

asio::awaitable<void> wait_for_news(LinkPtr link) {
  ErrorCode ignored;
  link->news.expires_at(std::chrono::steady_clock::time_point::max());
  co_await link->news.async_wait(into(ignored));
}

asio::awaitable<void> write_feed(LinkPtr link) {
  ErrorCode ec;
  while (!ec && !link->closed) {
    if (!link->feed) {
      co_await wait_for_news(link);
      continue;
    }
    if (const auto farewell = link->feed->farewell()) {
      const auto code = farewell->why == Farewell::Why::too_slow
                            ? websocket::close_code::try_again_later
                            : websocket::close_code::going_away;
      const websocket::close_reason reason(code, farewell->text.substr(0, 120));
      co_await link->socket.async_close(reason, into(ec));
      break;
    }
    if (const auto message = link->feed->next()) {
      co_await link->socket.async_write(asio::buffer(*message->text), into(ec));
    } else {
      co_await wait_for_news(link);
    }
  }
}

}  // namespace

asio::awaitable<void> serve_websocket(beast::tcp_stream stream,
                                      beast::http::request<beast::http::string_body> upgrade,
                                      Target target, const Site& site) {
  const auto link = std::make_shared<Link>(std::move(stream));
  ErrorCode ec;
  auto& socket = link->socket;
  beast::get_lowest_layer(socket).expires_never();
  beast::get_lowest_layer(socket).socket().set_option(
      asio::socket_base::send_buffer_size(kSendBuffer), ec);
  socket.set_option(websocket::stream_base::timeout{std::chrono::seconds(10), kIdle, true});
  socket.read_message_max(kMessageMax);
  socket.auto_fragment(false);
  socket.text(true);
  co_await socket.async_accept(upgrade, into(ec));
  if (ec) co_return;

  const std::weak_ptr<Link> weak = link;
  site.subscribe(target, [weak](FeedPtr feed) {
    const LinkPtr there = weak.lock();
    if (!there) return;
    there->feed = std::move(feed);
    there->feed->on_news([weak] {
      if (const LinkPtr still = weak.lock()) still->news.cancel();
    });
    there->news.cancel();
  });
  asio::co_spawn(socket.get_executor(), read_until_closed(link), asio::detached);
  co_await write_feed(link);
}

}  // namespace armloom
