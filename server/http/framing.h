#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.h"

namespace armloom {

// The fields of a request's header that decide where its body ends and whom it is for.
struct FramingFields {
  bool http_1_1 = true;
  std::vector<std::string_view> hosts;               // value of each Host field
  std::vector<std::string_view> transfer_encodings;  // of each Transfer-Encoding field
  std::vector<std::string_view> content_lengths;
};

struct FramingFault {
  std::string detail;
  std::optional<std::string> value;  // of the field
};

// Why the request must be refused with 400 and its connection closed (RFC 9112, 3.2 and 6.3): the
// parser lets a Transfer-Encoding other than "chunked" pass and would read the body as a second
// request, and does not look at Host at all. Empty: sound.
[[nodiscard]] std::optional<FramingFault> framing_fault(const FramingFields& fields);

// Host, or the authority of an Origin: a name, IPv4 or [IPv6], with an optional port.
[[nodiscard]] bool valid_authority(std::string_view text);

// Whether a browser's Origin ("http://host:port") is the site itself. Pages of other sites must not
// stop arms or post jobs through the visitor's browser. `is_sealed`: the site is served over TLS,
// so that its pages are https; without TLS of its own it may still stand behind a proxy that has
// it.
[[nodiscard]] bool same_origin(std::string_view origin, std::string_view host, bool is_sealed);

// The host of an authority, in small letters, without port, brackets and a last dot.
[[nodiscard]] std::string host_of(std::string_view authority);

// A target in absolute-form ("http://host:port/path?query"), in its two parts; absent: it is not,
// or its authority is not valid. An empty path is "/".
struct AbsoluteTarget {
  std::string authority;
  std::string rest;
};
[[nodiscard]] std::optional<AbsoluteTarget> split_absolute_target(std::string_view target);

// Whether `key` is sixteen bytes in base64 (RFC 6455, 4.1).
[[nodiscard]] bool is_websocket_key(std::string_view key);

// Whether the server may be asked by this name.
[[nodiscard]] bool may_command(const std::string& host, const HostRule& rule);

}  // namespace armloom
