#pragma once

#include <chrono>
#include <optional>

#include "server/http/connection.h"
#include "server/http/request_body.h"

namespace armloom {

// Why no request came of it: `refusal` is to be said, none: the peer has gone, or has begun none.
struct NoRequest {
  std::optional<Refusal> refusal = {};
};

struct ReadTimes {
  std::chrono::milliseconds idle;  // until the first bytes of a request
  std::chrono::milliseconds read;  // from then on for its header, and for its body
};

// Waits for the next request's first bytes, then reads its header. An empty line before it is read
// over.
Awaitable<std::optional<NoRequest>> read_header(Connection& connection, RequestParser& parser,
                                                ReadTimes times);

// Reads the body, at most kBodyMax of it, and of what stands around its chunks no more than of a
// header. `ask_for_it`: 100 Continue goes before.
Awaitable<std::optional<NoRequest>> read_body(Connection& connection, RequestParser& parser,
                                              std::chrono::milliseconds read_time, bool ask_for_it);

}  // namespace armloom
