#pragma once

#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/message.hpp>
#include <optional>
#include <string>

#include "server/http/error_code.h"
#include "server/http/message.h"

namespace armloom {

using RequestHeader = boost::beast::http::request_header<>;

// Returns a refusal if the header is invalid. The connection must then be closed.
[[nodiscard]] std::optional<Refusal> header_refusal(const RequestHeader& header);

// Adapts the version in a request line for Beast (RFC 9112, 2.3, and RFC 9110, 2.5). A higher minor
// version is overwritten with 1.1. Returns a refusal if the major version is not 1.
[[nodiscard]] std::optional<Refusal> settle_version(char* line, std::size_t size);

// Returns true if the request asks for a WebSocket upgrade. handshake_fault() returns a refusal if
// the upgrade is invalid (RFC 6455, 4.2.1).
[[nodiscard]] bool is_handshake(const RequestHeader& header);
[[nodiscard]] std::optional<Refusal> handshake_fault(const RequestHeader& header);

// Returns the request without its body. A host in the target takes precedence over Host (RFC 9112,
// 3.2.2). Refusal: the target is invalid.
[[nodiscard]] tl::expected<Request, Refusal> request_of(const RequestHeader& header,
                                                        const HostRule& hosts);

}  // namespace armloom
