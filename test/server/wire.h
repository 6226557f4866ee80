#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace armloom::test {

// A plain loopback socket with a deadline on every read: what a client does, byte for byte.
class Wire {
 public:
  // `receive_buffer`: bytes that the system takes for a reader that does not; zero: as it likes.
  // `from`: the client's address, one of the loopback's.
  explicit Wire(std::uint16_t port, int receive_buffer = 0, const char* from = "127.0.0.1");
  ~Wire();
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  // Whether all of it went: else the peer has closed, its answer says why.
  bool send(std::string_view bytes);
  // At least one byte more, or nothing: the peer has closed. Throws when a minute passes.
  bool receive();
  // Exactly `size` bytes from what was received; throws when the peer closes before.
  std::string take(std::size_t size);
  // Up to and with `mark`.
  std::string take_until(std::string_view mark);
  // Everything until the peer closes.
  std::string take_all();

 private:
  int fd_ = -1;
  std::string buffer_;
};

struct Answer {
  int status = 0;
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;

  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(body); }
};

// Begins a WebSocket; throws when it is refused.
void begin_websocket(Wire& wire, const std::string& query = "");
// One frame of a server, which masks none.
struct Frame {
  int first = 0;  // FIN, reserved bits and opcode
  std::string payload;
};
Frame take_frame(Wire& wire);
// Its bytes, the most significant first.
std::size_t number_of(const std::string& bytes);

// Reads one response from the wire. `head`: it has no body whatever its Content-Length says.
Answer read_answer(Wire& wire, bool head = false);

// One request on a connection of its own.
Answer request(std::uint16_t port, const std::string& method, const std::string& target,
               const std::string& body = "", const std::string& content_type = "application/json");
std::string request_text(const std::string& method, const std::string& target,
                         const std::string& body, const std::string& content_type);

// A WebSocket client that can only listen.
class Listener {
 public:
  Listener(std::uint16_t port, const std::string& query = "");

  struct Closed {
    int code = 0;
    std::string reason;
  };
  // The next text message; nullopt when the server has closed (see closed()).
  std::optional<nlohmann::json> next();
  // The next message of this type, others skipped.
  nlohmann::json next_of(const std::string& type);
  // The next message that has a seq.
  nlohmann::json next_event();
  [[nodiscard]] const Closed& closed() const { return closed_; }

 private:
  Wire wire_;
  Closed closed_;
};

}  // namespace armloom::test
