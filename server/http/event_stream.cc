#include "server/http/event_stream.h"

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "server/http/request_id.h"
#include "server/http/security_headers.h"
#include "server/http/stream_session.h"

namespace armloom {
namespace {

constexpr std::string_view kHead =
    "HTTP/1.1 200 OK\r\nServer: armloom\r\nContent-Type: text/event-stream\r\n"
    "Cache-Control: no-store\r\nConnection: close\r\n"
    "X-Accel-Buffering: no\r\n";  // reverse proxies must pass on each event at once

std::string head(const Request& request) {
  std::string text(kHead);
  const auto add = [&](std::string_view name, std::string_view value) {
    text.append(name).append(": ").append(value).append("\r\n");
  };
  for (const auto& [name, value] : kSecurityHeaders) add(name, value);
  add("Content-Security-Policy", kNoPagePolicy);
  add(kRequestIdField, request.id);
  Response across;
  answer_across_origins(request, across);
  for (const auto& [name, value] : across.headers) add(name, value);
  return text + "\r\n";
}

class SentEvents final : public StreamCarrier {
 public:
  SentEvents(Transport stream, std::string id, int send_buffer)
      : stream_(std::move(stream)), id_(std::move(id)) {
    ErrorCode ignored;
    stream_.socket().set_option(asio::socket_base::send_buffer_size(send_buffer), ignored);
    stream_.expires_never();
  }

  Executor executor() override { return stream_.get_executor(); }
  // Discards input. Only the end of the connection matters.
  Awaitable<void> read_until_closed() override {
    std::array<char, 1024> sink;
    ErrorCode ec;
    while (!ec) co_await stream_.read_some(asio::buffer(sink), ec);
  }
  Awaitable<void> write(std::string_view text, ErrorCode& ec) {
    co_await stream_.write(asio::buffer(text), {}, ec);
  }
  Awaitable<void> send(const Subscription::Message& message, ErrorCode& ec) override {
    std::string text;
    text.reserve(message.text->size() + 80);
    if (message.seq) text += "id: " + id_ + ":" + std::to_string(*message.seq) + "\n";
    text += "data: ";
    text += *message.text;  // JSON on one line
    text += "\n\n";
    co_await write(text, ec);
  }
  Awaitable<void> keep_alive(ErrorCode& ec) override { co_await write(": keep-alive\n\n", ec); }
  Awaitable<void> say_why(const CloseReason& reason, ErrorCode& ec) override {
    const std::string text = ": " + reason.text + "\n\n";
    co_await write(text, ec);
  }
  void close() override { stream_.close(); }
  void cut() override { stream_.close(); }

 private:
  Transport stream_;
  std::string id_;
};

}  // namespace

Awaitable<void> serve_event_stream(Transport stream, const Request& request, EventStream events,
                                   const Site& site, bool only_head) {
  const auto carrier = std::make_shared<SentEvents>(std::move(stream), events.id, site.send_buffer);
  ErrorCode ec;
  const std::string first = head(request);
  co_await carrier->write(first, ec);
  if (!ec && !only_head)
    co_await carry(std::move(events), carrier, {site.send_time, site.keep_alive});
}

}  // namespace armloom
