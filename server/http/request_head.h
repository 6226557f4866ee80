#pragma once

#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/message.hpp>
#include <optional>
#include <string>

#include "server/http/error_code.h"
#include "server/http/message.h"

namespace armloom {

using RequestHeader = boost::beast::http::request_header<>;

// What must be refused before the body is read; the connection ends with it.
[[nodiscard]] std::optional<Refusal> header_refusal(const RequestHeader& header);

// Makes ready what Beast does not take of a request's first line, which begins at `data` (RFC 9112,
// 2.3, and RFC 9110, 2.5): a higher minor version becomes 1.1 in place; another major one is
// refused.
[[nodiscard]] std::optional<Refusal> settle_version(char* line, std::size_t size);

// Whether the header asks for a WebSocket, and what is wrong with how it does (RFC 6455, 4.2.1).
[[nodiscard]] bool is_handshake(const RequestHeader& header);
[[nodiscard]] std::optional<Refusal> handshake_fault(const RequestHeader& header);

// The request, all but its body. Its target may have a host of its own, which counts instead of
// Host (RFC 9112, 3.2.2). Refusal: the target cannot be read.
[[nodiscard]] tl::expected<Request, Refusal> request_of(const RequestHeader& header,
                                                        const HostRule& hosts);

}  // namespace armloom
