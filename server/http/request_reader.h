#pragma once

#include <chrono>
#include <optional>

#include "server/http/connection.h"
#include "server/http/request_body.h"

namespace armloom {

// Why no request was read. `refusal` is nullopt if the client disconnected or sent nothing.
struct NoRequest {
  std::optional<Refusal> refusal = {};
};

struct ReadTimes {
  std::chrono::milliseconds idle;  // until the first bytes of a request
  std::chrono::milliseconds read;  // then for the whole header, and for the whole body
};

// Waits for the next request and reads its header. Skips a few empty lines before the request.
// Returns nullopt on success.
Awaitable<std::optional<NoRequest>> read_header(Connection& connection, RequestParser& parser,
                                                ReadTimes times);

// Reads the body, at most kBodyMax bytes. Limits chunk extensions and trailers, too. Returns
// nullopt on success. `ask_for_it`: sends 100 Continue first.
Awaitable<std::optional<NoRequest>> read_body(Connection& connection, RequestParser& parser,
                                              std::chrono::milliseconds read_time, bool ask_for_it);

}  // namespace armloom
