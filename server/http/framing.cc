#include "server/http/framing.h"

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

std::optional<std::string> framing_fault(const FramingFields& fields) {
  if (fields.hosts.empty() && fields.http_1_1) return "the Host field is missing";
  if (fields.hosts.size() > 1) return "the Host field occurs more than once";
  if (!fields.hosts.empty() && !valid_authority(fields.hosts.front())) {
    return "Host is not a name with an optional port: \"" + std::string(fields.hosts.front()) +
           "\"";
  }
  if (fields.content_lengths.size() > 1) return "the Content-Length field occurs more than once";
  if (!fields.content_lengths.empty()) {
    const std::string_view length = fields.content_lengths.front();
    if (length.empty() || !std::all_of(length.begin(), length.end(), is_digit)) {
      return "Content-Length is not a number: \"" + std::string(length) + "\"";
    }
  }
  if (fields.transfer_encodings.empty()) return std::nullopt;
  if (!fields.http_1_1) return "HTTP/1.0 has no Transfer-Encoding";
  if (!fields.content_lengths.empty()) return "both Transfer-Encoding and Content-Length are given";
  if (fields.transfer_encodings.size() > 1 ||
      !equals_ignoring_case(fields.transfer_encodings.front(), "chunked")) {
    return "the only Transfer-Encoding served is \"chunked\", found \"" +
           std::string(fields.transfer_encodings.front()) + "\"";
  }
  return std::nullopt;
}

bool same_origin(std::string_view origin, std::string_view host) {
  const std::size_t scheme = origin.find("://");
  return scheme != origin.npos && equals_ignoring_case(origin.substr(scheme + 3), host);
}

}  // namespace armloom
