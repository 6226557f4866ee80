#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace armloom::test {

// A plain loopback socket with a deadline on every read, for tests that send exact bytes.
class Wire {
 public:
  // `receive_buffer`: size of the receive buffer in bytes; 0: system default. `from`: the client's
  // loopback address.
  explicit Wire(std::uint16_t port, int receive_buffer = 0, const char* from = "127.0.0.1");
  ~Wire();
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  // Returns false if the peer has closed the connection.
  bool send(std::string_view bytes);
  // Receives at least one byte; false if the peer has closed. Throws after a minute.
  bool receive();
  // Returns exactly `size` received bytes; throws if the peer closes before.
  std::string take(std::size_t size);
  // Returns everything up to and including `mark`.
  std::string take_until(std::string_view mark);
  // Returns everything until the peer closes.
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

// Upgrades to a WebSocket; throws if the server refuses.
void begin_websocket(Wire& wire, const std::string& query = "");
// A frame of the server; server frames are unmasked.
struct Frame {
  int first = 0;  // FIN, reserved bits and opcode
  std::string payload;
};
Frame take_frame(Wire& wire);
// Returns the big-endian number.
std::size_t number_of(const std::string& bytes);

// Reads one response. `head`: a response to HEAD, without a body.
Answer read_answer(Wire& wire, bool head = false);

// Sends one request on a new connection.
Answer request(std::uint16_t port, const std::string& method, const std::string& target,
               const std::string& body = "", const std::string& content_type = "application/json");
std::string request_text(const std::string& method, const std::string& target,
                         const std::string& body, const std::string& content_type);

// A WebSocket client that only listens.
class Listener {
 public:
  Listener(std::uint16_t port, const std::string& query = "");

  struct Closed {
    int code = 0;
    std::string reason;
  };
  // Returns the next text message; nullopt if the server has closed (see closed()).
  std::optional<nlohmann::json> next();
  // Returns the next message of this type.
  nlohmann::json next_of(const std::string& type);
  // Returns the next message with a seq.
  nlohmann::json next_event();
  [[nodiscard]] const Closed& closed() const { return closed_; }

 private:
  Wire wire_;
  Closed closed_;
};

}  // namespace armloom::test
