#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.h"

namespace armloom {

// Header fields that decide where the body ends and which host the request addresses.
struct FramingFields {
  bool http_1_1 = true;
  std::vector<std::string_view> hosts;               // value of each Host field
  std::vector<std::string_view> transfer_encodings;  // of each Transfer-Encoding field
  std::vector<std::string_view> content_lengths;
};

struct FramingFault {
  std::string field;
  std::string detail;
  std::optional<std::string> value;  // of the field
};

// Returns why the request must be refused with 400 and its connection closed (RFC 9112, 3.2 and
// 6.3); nullopt if its framing is sound. Beast's parser alone is not enough: it does not check
// Host, and it accepts any Transfer-Encoding. It would then read the body as a second request
// (request smuggling).
[[nodiscard]] std::optional<FramingFault> framing_fault(const FramingFields& fields);

// Checks a Host, or the authority of an Origin: a name, IPv4 or [IPv6], with an optional port.
[[nodiscard]] bool valid_authority(std::string_view text);

// Returns why X-Forwarded-Prefix cannot be put before a path, or nullopt. It must begin with one
// slash and consist of path characters (RFC 3986, 3.3) without "." and ".." segments; a browser
// would take "//host" for another site.
[[nodiscard]] std::optional<std::string> prefix_fault(std::string_view prefix);

// Returns the refusal of a header with a field that continues on a second line (obs-fold; RFC 9112,
// 5.2), or nullopt. `text` is the input from the request line on.
[[nodiscard]] std::optional<Refusal> folded_field(std::string_view text);

// Returns true if a browser's Origin ("http://host:port") is this site. Protects against CSRF:
// pages of other sites must not stop arms or post jobs through a visitor's browser. `is_sealed`:
// the site uses TLS, so the Origin must be https. Otherwise any scheme is accepted, because a proxy
// may add TLS.
[[nodiscard]] bool same_origin(std::string_view origin, std::string_view host, bool is_sealed);

// Returns the host of an authority in lowercase, without port, brackets and trailing dot.
[[nodiscard]] std::string host_of(std::string_view authority);

// An absolute-form target ("http://host:port/path?query"), split; an empty path becomes "/".
// split_absolute_target() returns nullopt for any other form of target or an invalid authority.
struct AbsoluteTarget {
  std::string authority;
  std::string rest;
};
[[nodiscard]] std::optional<AbsoluteTarget> split_absolute_target(std::string_view target);

// Checks that `key` is sixteen bytes in base64 (RFC 6455, 4.1).
[[nodiscard]] bool is_websocket_key(std::string_view key);

// Checks the host that a request addresses (from host_of()) against the allow-list.
[[nodiscard]] bool is_allowed_host(const std::string& host, const HostRule& rule);

}  // namespace armloom
