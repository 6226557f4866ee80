#include "test/server/wire.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace armloom::test {
namespace {

constexpr int kPatience_ms = 60'000;

}  // namespace

Wire::Wire(std::uint16_t port, int receive_buffer, const char* from)
    : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
  if (receive_buffer > 0) {
    setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = inet_addr(from);
  if (bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("cannot come from that address");
  }
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("cannot connect");
  }
}

Wire::~Wire() { close(fd_); }

bool Wire::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool Wire::receive() {
  pollfd waiting{fd_, POLLIN, 0};
  if (poll(&waiting, 1, kPatience_ms) <= 0) throw std::runtime_error("no byte came in time");
  std::array<char, 16384> bytes;
  const ssize_t size = recv(fd_, bytes.data(), bytes.size(), 0);
  if (size <= 0) return false;
  buffer_.append(bytes.data(), static_cast<std::size_t>(size));
  return true;
}

std::string Wire::take(std::size_t size) {
  while (buffer_.size() < size) {
    if (!receive()) throw std::runtime_error("closed in the middle of a message");
  }
  std::string bytes = buffer_.substr(0, size);
  buffer_.erase(0, size);
  return bytes;
}

std::string Wire::take_until(std::string_view mark) {
  std::size_t at = 0;
  while ((at = buffer_.find(mark)) == std::string::npos) {
    if (!receive()) throw std::runtime_error("closed in the middle of a message: " + buffer_);
  }
  return take(at + mark.size());
}

std::string Wire::take_all() {
  while (receive()) {
  }
  return std::exchange(buffer_, {});
}

Answer read_answer(Wire& wire, bool head) {
  Answer answer;
  const std::string status_line = wire.take_until("\r\n");
  answer.status = std::stoi(status_line.substr(9, 3));
  for (;;) {
    const std::string line = wire.take_until("\r\n");
    if (line == "\r\n") break;
    const std::size_t colon = line.find(':');
    std::string name = line.substr(0, colon);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    answer.headers[name] = line.substr(colon + 2, line.size() - colon - 4);
  }
  if (answer.status == 100) return read_answer(wire, head);
  if (answer.status == 204) return answer;
  if (!head) answer.body = wire.take(std::stoul(answer.headers.at("content-length")));
  return answer;
}

std::string request_text(const std::string& method, const std::string& target,
                         const std::string& body, const std::string& content_type) {
  std::string text = method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1\r\n";
  if (!body.empty() || method == "POST" || method == "PUT") {
    text += "Content-Type: " + content_type + "\r\n";
    text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  }
  return text + "\r\n" + body;
}

Answer request(std::uint16_t port, const std::string& method, const std::string& target,
               const std::string& body, const std::string& content_type) {
  Wire wire(port);
  wire.send(request_text(method, target, body, content_type));
  return read_answer(wire, method == "HEAD");
}

void begin_websocket(Wire& wire, const std::string& query) {
  wire.send("GET /api/v1/ws" + query +
            " HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
  const std::string head = wire.take_until("\r\n\r\n");
  if (!head.starts_with("HTTP/1.1 101")) throw std::runtime_error("no upgrade: " + head);
}

std::size_t number_of(const std::string& bytes) {
  std::size_t number = 0;
  for (const char byte : bytes) number = number << 8U | static_cast<unsigned char>(byte);
  return number;
}

Frame take_frame(Wire& wire) {
  const std::string head = wire.take(2);
  std::size_t size = static_cast<unsigned char>(head[1]);
  if (size >= 126) size = number_of(wire.take(size == 126 ? 2 : 8));
  return {static_cast<unsigned char>(head[0]), wire.take(size)};
}

Listener::Listener(std::uint16_t port, const std::string& query) : wire_(port) {
  begin_websocket(wire_, query);
}

std::optional<nlohmann::json> Listener::next() {
  for (;;) {
    const auto [first, payload] = take_frame(wire_);
    const int opcode = first & 0x0F;
    if (opcode == 1) return nlohmann::json::parse(payload);
    if (opcode == 8) {
      if (payload.size() >= 2) {
        closed_.code = static_cast<int>(number_of(payload.substr(0, 2)));
        closed_.reason = payload.substr(2);
      }
      return std::nullopt;
    }
  }
}

nlohmann::json Listener::next_of(const std::string& type) {
  for (;;) {
    auto message = next();
    if (!message) throw std::runtime_error("closed: " + closed_.reason);
    if (message->at("type") == type) return *message;
  }
}

nlohmann::json Listener::next_event() {
  for (;;) {
    auto message = next();
    if (!message) throw std::runtime_error("closed: " + closed_.reason);
    if (message->contains("seq")) return *message;
  }
}

}  // namespace armloom::test
