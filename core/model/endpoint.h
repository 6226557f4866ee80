#pragma once

#include <string>

#include "core/base/problem.h"

namespace armloom {

// Address of a controller in another process: a Unix socket, or a TCP port.
struct Endpoint {
  std::string path;  // of the Unix socket; empty for TCP
  std::string host;  // name or address, without brackets
  std::string port;  // 0 to 65535

  [[nodiscard]] bool is_unix() const { return !path.empty(); }
  // Returns the text that parse_endpoint() reads.
  [[nodiscard]] std::string text() const;
};

// Parses "unix:PATH", "tcp:HOST:PORT" or "tcp:[::1]:PORT". Problem (bad-endpoint): without a
// pointer; the value is `text`.
[[nodiscard]] Result<Endpoint> parse_endpoint(const std::string& text);

}  // namespace armloom
