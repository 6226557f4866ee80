#include "core/model/endpoint.h"

#include <charconv>
#include <cstdint>
#include <string_view>
#include <utility>

namespace armloom {
namespace {

constexpr std::string_view kUnix = "unix:";
constexpr std::string_view kTcp = "tcp:";
constexpr std::size_t kUnixPathMax = 107;  // sockaddr_un::sun_path, without its NUL

tl::unexpected<Problems> bad_endpoint(const std::string& text, const std::string& why) {
  return failure(Problem{ProblemKind::invalid, "bad-endpoint", "",
                         why + ": expected unix:PATH or tcp:HOST:PORT, for example "
                               "unix:/run/left.sock or tcp:127.0.0.1:4000",
                         text});
}

bool is_port(std::string_view text) {
  std::uint16_t port = 0;
  const auto [stop, ec] = std::from_chars(text.data(), text.data() + text.size(), port);
  return ec == std::errc{} && stop == text.data() + text.size();
}

}  // namespace

std::string Endpoint::text() const {
  if (is_unix()) return std::string(kUnix) + path;
  const bool is_v6 = host.find(':') != host.npos;
  return std::string(kTcp) + (is_v6 ? "[" + host + "]" : host) + ":" + port;
}

Result<Endpoint> parse_endpoint(const std::string& text) {
  if (text.starts_with(kUnix)) {
    std::string path = text.substr(kUnix.size());
    if (path.empty()) return bad_endpoint(text, "the path is missing");
    if (path.size() > kUnixPathMax) {
      return bad_endpoint(text, "the path of a Unix socket has at most " +
                                    std::to_string(kUnixPathMax) + " characters, this one has " +
                                    std::to_string(path.size()));
    }
    return Endpoint{.path = std::move(path), .host = {}, .port = {}};
  }
  if (!text.starts_with(kTcp)) return bad_endpoint(text, "not an endpoint");
  const std::string rest = text.substr(kTcp.size());
  const std::size_t colon = rest.rfind(':');
  if (colon == rest.npos || colon == 0) return bad_endpoint(text, "host or port is missing");
  std::string host = rest.substr(0, colon);
  std::string port = rest.substr(colon + 1);
  if (!is_port(port)) return bad_endpoint(text, "the port is not a number from 0 to 65535");
  if (host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != host.npos) {
    return bad_endpoint(text, "an IPv6 address stands in brackets");
  }
  return Endpoint{.path = {}, .host = std::move(host), .port = std::move(port)};
}

}  // namespace armloom
