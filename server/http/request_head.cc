#include "server/http/request_head.h"

#include <algorithm>
#include <array>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <utility>
#include <vector>

#include "server/http/framing.h"

namespace armloom {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

std::vector<std::string_view> all_of(const RequestHeader& header, beast::string_view name) {
  std::vector<std::string_view> values;
  const auto [begin, end] = header.equal_range(name);
  for (auto field = begin; field != end; ++field) values.push_back(view(field->value()));
  return values;
}

std::optional<std::string> one_of(const RequestHeader& header, beast::string_view name) {
  const auto it = header.find(name);
  return it == header.end() ? std::nullopt : std::optional(std::string(it->value()));
}

// Returns the refusal of every request, even to read, if its host is not allowed (DNS rebinding).
std::optional<Refusal> foreign_host(const std::string& authority, const HostRule& hosts) {
  const std::string host = host_of(authority);
  if (authority.empty() || is_allowed_host(host, hosts)) return std::nullopt;
  return Refusal{403, "foreign-host",
                 "host \"" + host +
                     "\" is not allowed: use an IP address, localhost or a name given with "
                     "--allow-host",
                 std::nullopt, host};
}

// Returns the refusal of commands and subscriptions if the request comes from a page of another
// site.
std::optional<Refusal> foreign_origin(const RequestHeader& header, const std::string& authority,
                                      const HostRule& hosts) {
  const auto origin = header.find(http::field::origin);
  if (origin == header.end() || same_origin(view(origin->value()), authority, hosts.is_sealed)) {
    return std::nullopt;
  }
  const std::string site(origin->value());
  const bool is_site = split_absolute_target(site).has_value();
  return Refusal{403, "foreign-origin",
                 "pages of another site may not command this server" +
                     (is_site ? ": to allow this site, start the server with --allow-origin " + site
                              : std::string()),
                 "Origin", site};
}

// Returns the token of the Authorization header ("Bearer <token>"), or else of the first cookie
// named kTokenCookie.
std::optional<std::string> token_of(const RequestHeader& header) {
  static constexpr std::string_view kScheme = "bearer ";
  const std::string authorization = one_of(header, "Authorization").value_or("");
  if (authorization.size() > kScheme.size() &&
      beast::iequals({authorization.data(), kScheme.size()}, {kScheme.data(), kScheme.size()})) {
    const std::size_t begins = authorization.find_first_not_of(' ', kScheme.size());
    return begins == authorization.npos ? "" : authorization.substr(begins);
  }
  const std::string name = std::string(kTokenCookie) + "=";
  for (std::string_view cookies : all_of(header, "Cookie")) {
    while (!cookies.empty()) {
      std::string_view one = cookies.substr(0, cookies.find(';'));
      cookies.remove_prefix(std::min(cookies.size(), one.size() + 1));
      while (one.starts_with(' ')) one.remove_prefix(1);
      if (one.starts_with(name)) return std::string(one.substr(name.size()));
    }
  }
  return std::nullopt;
}

// Returns the Origin header if pages of that origin may command, or nullopt.
std::optional<std::string> allowed_origin(const RequestHeader& header, const HostRule& hosts) {
  auto origin = one_of(header, "Origin");
  const bool may =
      origin && std::ranges::any_of(hosts.origins, [&](const std::string& one) {
        return beast::iequals({one.data(), one.size()}, {origin->data(), origin->size()});
      });
  return may ? std::move(origin) : std::nullopt;
}

// Fields of which a request may have only one. If there were two, this server and a proxy before it
// could each use another one.
struct SingleField {
  std::string_view name;
  bool is_secret = false;
};
constexpr std::array<SingleField, 13> kSingleFields{{{"Host"},
                                                     {"Content-Length"},
                                                     {"Transfer-Encoding"},
                                                     {"Content-Type"},
                                                     {"Content-Encoding"},
                                                     {"Authorization", true},
                                                     {"Origin"},
                                                     {"Idempotency-Key"},
                                                     {"If-Match"},
                                                     {"If-None-Match"},
                                                     {"Last-Event-ID"},
                                                     {"X-Request-Id"},
                                                     {"X-Forwarded-Prefix"}}};

std::string joined(const RequestHeader& header, beast::string_view name) {
  std::string all;
  for (const std::string_view value : all_of(header, name)) {
    all.append(all.empty() ? "" : ", ").append(value);
  }
  return all;
}

tl::expected<Target, Refusal> target_of(const RequestHeader& header, std::string& authority) {
  std::string_view text = view(header.target());
  if (text == "*" && header.method() == http::verb::options) return Target{"*", {}};
  std::string path;
  if (const auto absolute = split_absolute_target(text)) {
    authority = absolute->authority;
    path = absolute->rest;
    text = path;
  }
  auto target = parse_target(text);
  if (!target) return tl::unexpected(refusal_of(400, target.error().front()));
  return std::move(*target);
}

}  // namespace

std::optional<Refusal> header_refusal(const RequestHeader& header) {
  for (const auto& [name, is_secret] : kSingleFields) {
    const auto values = all_of(header, {name.data(), name.size()});
    if (values.size() < 2) continue;
    Refusal refusal{400, "bad-request",
                    "the " + std::string(name) + " field occurs more than once: send it once",
                    std::string(name)};
    if (!is_secret) refusal.value = std::string(values[1]);
    return refusal;
  }
  FramingFields fields;
  fields.http_1_1 = header.version() >= 11;
  fields.hosts = all_of(header, "Host");
  fields.transfer_encodings = all_of(header, "Transfer-Encoding");
  fields.content_lengths = all_of(header, "Content-Length");
  if (const auto fault = framing_fault(fields)) {
    return Refusal{400, "bad-request", fault->detail, fault->field, fault->value};
  }
  const auto expect = header.find(http::field::expect);
  if (fields.http_1_1 && expect != header.end() &&
      !beast::iequals(expect->value(), "100-continue")) {
    return Refusal{417, "expectation-failed", "the only Expect served is 100-continue",
                   std::nullopt, std::string(expect->value())};
  }
  return std::nullopt;
}

std::optional<Refusal> settle_version(char* line, std::size_t size) {
  const std::string_view text(line, size);
  const std::size_t space = text.rfind(' ');
  const std::string_view version = space == text.npos ? "" : text.substr(space + 1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const bool whole = version.size() == 8 && version.starts_with("HTTP/") && is_digit(version[5]) &&
                     version[6] == '.' && is_digit(version[7]);
  if (!whole) return std::nullopt;  // the parser reports the fault
  if (version[5] != '1') {
    return Refusal{505, "http-version-not-supported", "HTTP/1.1 and HTTP/1.0 are served",
                   std::nullopt, std::string(version)};
  }
  if (version[7] > '1') line[space + 8] = '1';
  return std::nullopt;
}

bool is_handshake(const RequestHeader& header) {
  return header.version() >= 11 && header.method() == http::verb::get &&
         http::token_list(header[http::field::connection]).exists("upgrade") &&
         http::token_list(header[http::field::upgrade]).exists("websocket");
}

std::optional<Refusal> handshake_fault(const RequestHeader& header) {
  const auto versions = all_of(header, "Sec-WebSocket-Version");
  if (versions.size() != 1 || versions.front() != "13") {
    return Refusal{426,
                   "upgrade-required",
                   "Sec-WebSocket-Version must be 13",
                   std::nullopt,
                   versions.empty() ? std::nullopt : std::optional(std::string(versions.front())),
                   {{"Upgrade", "websocket"}, {"Sec-WebSocket-Version", "13"}}};
  }
  const auto keys = all_of(header, "Sec-WebSocket-Key");
  if (keys.size() == 1 && is_websocket_key(keys.front())) return std::nullopt;
  return Refusal{400, "bad-handshake", "Sec-WebSocket-Key must be sixteen bytes in base64, once",
                 std::nullopt,
                 keys.empty() ? std::nullopt : std::optional(std::string(keys.front()))};
}

tl::expected<Request, Refusal> request_of(const RequestHeader& header, const HostRule& hosts) {
  std::string authority = one_of(header, "Host").value_or("");
  auto target = target_of(header, authority);
  if (!target) return tl::unexpected(std::move(target.error()));
  Request request;
  request.method =
      header.method() == http::verb::head ? "GET" : std::string(header.method_string());
  request.target = std::move(*target);
  request.content_type = one_of(header, "Content-Type");
  request.content_encoding = one_of(header, "Content-Encoding");
  request.last_event_id = one_of(header, "Last-Event-ID");
  request.token = token_of(header);
  request.idempotency_key = one_of(header, "Idempotency-Key");
  request.if_none_match = one_of(header, "If-None-Match");
  request.if_match = one_of(header, "If-Match");
  request.accept = joined(header, "Accept");
  request.accept_encoding = joined(header, "Accept-Encoding");
  request.prefix = one_of(header, "X-Forwarded-Prefix").value_or("");
  if (const auto fault = request.prefix.empty() ? std::nullopt : prefix_fault(request.prefix)) {
    return tl::unexpected(
        Refusal{400, "bad-request", *fault, "X-Forwarded-Prefix", request.prefix});
  }
  while (request.prefix.ends_with('/')) request.prefix.pop_back();
  request.stranger = foreign_host(authority, hosts);
  request.cross_origin = allowed_origin(header, hosts);
  request.foreign = request.stranger ? request.stranger : foreign_origin(header, authority, hosts);
  if (request.cross_origin) request.foreign = request.stranger;
  return request;
}

}  // namespace armloom
