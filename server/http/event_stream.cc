#include "server/http/event_stream.h"

#include <array>
#include <boost/asio/write.hpp>
#include <chrono>
#include <memory>
#include <string>

namespace armloom {
namespace {

namespace beast = boost::beast;

constexpr int kSendBuffer = 128 * 1024;

constexpr std::string_view kHead =
    "HTTP/1.1 200 OK\r\nServer: armloom\r\nContent-Type: text/event-stream\r\n"
    "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n";

// Reader and writer of one connection, both on the server's thread.
struct Link {
  explicit Link(beast::tcp_stream connection)
      : stream(std::move(connection)), news(stream.get_executor()) {}

  beast::tcp_stream stream;
  asio::steady_timer news;  // cancelled when there is something to do
  FeedPtr feed;
  bool closed = false;
};
using LinkPtr = std::shared_ptr<Link>;

// A client has nothing to say here; that it has gone is what is waited for, without the stream's
// timeout, which is one for each write and would cut the reading off with it.
asio::awaitable<void> read_until_closed(LinkPtr link) {
  std::array<char, 1024> sink;
  ErrorCode ec;
  while (!ec) co_await link->stream.socket().async_read_some(asio::buffer(sink), into(ec));
  link->closed = true;
  link->news.cancel();
}

asio::awaitable<void> write(LinkPtr link, const Site& site, std::string_view text, ErrorCode& ec) {
  link->stream.expires_after(site.send_time);
  co_await asio::async_write(link->stream, asio::buffer(text), into(ec));
}

std::string event_text(const Feed::Message& message, const std::string& stream) {
  std::string text;
  text.reserve(message.text->size() + 80);
  if (message.seq) text += "id: " + stream + ":" + std::to_string(*message.seq) + "\n";
  text += "data: ";
  text += *message.text;  // JSON on one line
  text += "\n\n";
  return text;
}

asio::awaitable<void> write_feed(LinkPtr link, bool poses, const Site& site) {
  ErrorCode ec;
  co_await write(link, site, kHead, ec);
  // Counted from the last byte sent: news that this reader does not get wakes it, too.
  auto keep_alive_at = std::chrono::steady_clock::now() + site.keep_alive;
  while (!ec && !link->closed) {
    if (link->feed) {
      if (const auto farewell = link->feed->farewell()) {
        co_await write(link, site, ": " + farewell->text + "\n\n", ec);
        break;
      }
      if (const auto message = link->feed->next()) {
        if (!message->seq && !poses) continue;
        const std::string text = event_text(*message, site.stream);
        co_await write(link, site, text, ec);
        keep_alive_at = std::chrono::steady_clock::now() + site.keep_alive;
        continue;
      }
    }
    link->news.expires_at(keep_alive_at);
    ErrorCode woken;
    co_await link->news.async_wait(into(woken));
    if (woken) continue;
    co_await write(link, site, ": keep-alive\n\n", ec);
    keep_alive_at = std::chrono::steady_clock::now() + site.keep_alive;
  }
  link->stream.close();
}

}  // namespace

void resume_after(std::string_view last_event_id, Target& target) {
  const std::size_t colon = last_event_id.rfind(':');
  target.query["stream"] = std::string(last_event_id.substr(0, colon));
  target.query["since"] =
      std::string(colon == last_event_id.npos ? "" : last_event_id.substr(colon + 1));
}

asio::awaitable<void> serve_event_stream(beast::tcp_stream stream, Target target,
                                         const Site& site) {
  const auto link = std::make_shared<Link>(std::move(stream));
  ErrorCode ignored;
  link->stream.socket().set_option(asio::socket_base::send_buffer_size(kSendBuffer), ignored);
  link->stream.expires_never();
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
  asio::co_spawn(link->stream.get_executor(), read_until_closed(link), asio::detached);
  co_await write_feed(link, target.parameter("poses") == "1", site);
}

}  // namespace armloom
