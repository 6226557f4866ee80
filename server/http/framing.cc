#include "server/http/framing.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>

namespace armloom {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

}  // namespace

bool valid_authority(std::string_view text) {
  std::string_view host = text;
  std::string_view port;
  const std::size_t bracket = text.find(']');
  const std::size_t colon = text.find(':', bracket == text.npos ? 0 : bracket);
  if (colon != text.npos) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (port.size() > 5 || !std::all_of(port.begin(), port.end(), is_digit)) return false;
  }
  if (host.empty() || host.size() > 255) return false;
  if (host.front() == '[') {
    host.remove_prefix(1);
    return host.size() > 2 && host.back() == ']' &&
           std::all_of(host.begin(), host.end() - 1, [](char c) {
             return std::isxdigit(static_cast<unsigned char>(c)) != 0 || c == ':' || c == '.';
           });
  }
  return std::all_of(host.begin(), host.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_';
  });
}

std::optional<FramingFault> framing_fault(const FramingFields& fields) {
  const auto fault = [](const char* field, std::string detail,
                        std::optional<std::string_view> value = {}) {
    return FramingFault{field,
                        value ? detail + ": \"" + std::string(*value) + "\"" : std::move(detail),
                        value ? std::optional<std::string>(*value) : std::nullopt};
  };
  if (fields.hosts.empty() && fields.http_1_1) return fault("Host", "the Host field is missing");
  if (!fields.hosts.empty() && !valid_authority(fields.hosts.front())) {
    return fault("Host", "Host is not a name with an optional port", fields.hosts.front());
  }
  const auto& lengths = fields.content_lengths;
  if (!lengths.empty() &&
      (lengths[0].empty() || !std::all_of(lengths[0].begin(), lengths[0].end(), is_digit))) {
    return fault("Content-Length", "Content-Length is not a number", lengths[0]);
  }
  const auto& encodings = fields.transfer_encodings;
  if (encodings.empty()) return std::nullopt;
  constexpr const char* kEncoding = "Transfer-Encoding";
  if (!fields.http_1_1) {
    return fault(kEncoding, "HTTP/1.0 has no Transfer-Encoding, found", encodings[0]);
  }
  if (!lengths.empty()) {
    return fault("Content-Length",
                 "both Transfer-Encoding and Content-Length are given, the latter", lengths[0]);
  }
  if (!equals_ignoring_case(encodings[0], "chunked")) {
    return fault(kEncoding, "the only Transfer-Encoding served is \"chunked\", found",
                 encodings[0]);
  }
  return std::nullopt;
}

std::optional<std::string> prefix_fault(std::string_view prefix) {
  if (!prefix.starts_with('/') || prefix.starts_with("//")) {
    return "X-Forwarded-Prefix must begin with one slash, for example /cell7";
  }
  const auto is_path_character = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("-._~!$&'()*+,;=:@%/").find(c) != std::string_view::npos;
  };
  const bool has_dots = (std::string(prefix) + "/").find("/./") != std::string::npos ||
                        (std::string(prefix) + "/").find("/../") != std::string::npos;
  if (has_dots || !std::all_of(prefix.begin(), prefix.end(), is_path_character)) {
    return "X-Forwarded-Prefix must be a path without query and without \".\" and \"..\" segments, "
           "for example /cell7";
  }
  return std::nullopt;
}

std::optional<Refusal> folded_field(std::string_view text) {
  for (std::size_t line = 0;;) {
    const std::size_t end = text.find("\r\n", line);
    if (end == text.npos || end == line) return std::nullopt;
    const std::size_t next = end + 2;
    if (next < text.size() && (text[next] == ' ' || text[next] == '\t')) {
      const std::string_view folded = text.substr(line, end - line);
      const std::string name(line == 0 ? "first" : folded.substr(0, folded.find(':')));
      return Refusal{400, "bad-request",
                     "the " + name + " field continues on a second line (obs-fold): send it on one",
                     name};
    }
    line = next;
  }
}

std::string host_of(std::string_view authority) {
  const std::size_t bracket = authority.find(']');
  const std::size_t colon = authority.find(':', bracket == authority.npos ? 0 : bracket);
  std::string host(authority.substr(0, colon));
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  if (host.size() > 1 && host.ends_with('.')) host.pop_back();
  for (char& c : host) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return host;
}

std::optional<AbsoluteTarget> split_absolute_target(std::string_view target) {
  const std::size_t scheme = target.find("://");
  if (scheme == target.npos || (!equals_ignoring_case(target.substr(0, scheme), "http") &&
                                !equals_ignoring_case(target.substr(0, scheme), "https"))) {
    return std::nullopt;
  }
  target.remove_prefix(scheme + 3);
  const std::size_t end = std::min(target.find_first_of("/?#"), target.size());
  if (!valid_authority(target.substr(0, end))) return std::nullopt;
  AbsoluteTarget split{std::string(target.substr(0, end)), std::string(target.substr(end))};
  if (!split.rest.starts_with('/')) split.rest.insert(0, "/");
  return split;
}

// Sixteen bytes are 22 base64 digits and two padding characters. The four spare bits of the last
// digit must be zero.
bool is_websocket_key(std::string_view key) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  return key.size() == 24 && key.ends_with("==") &&
         key.substr(0, 22).find_first_not_of(kDigits) == key.npos &&
         kDigits.find(key[21]) % 16 == 0;
}

bool is_allowed_host(const std::string& host, const HostRule& rule) {
  in6_addr address{};
  if (inet_pton(AF_INET, host.c_str(), &address) == 1) return true;
  if (inet_pton(AF_INET6, host.c_str(), &address) == 1) return true;
  if (host == "localhost" || host.ends_with(".localhost")) return true;
  if (rule.any_plain && host.find('.') == host.npos) return true;
  return std::any_of(rule.names.begin(), rule.names.end(),
                     [&](const std::string& name) { return host_of(name) == host; });
}

bool same_origin(std::string_view origin, std::string_view host, bool is_sealed) {
  const std::size_t scheme = origin.find("://");
  if (scheme == origin.npos || !equals_ignoring_case(origin.substr(scheme + 3), host)) return false;
  return !is_sealed || equals_ignoring_case(origin.substr(0, scheme), "https");
}

}  // namespace armloom
