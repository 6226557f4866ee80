#pragma once

#include <functional>
#include <optional>

#include "server/http/connection.h"
#include "server/http/request_head.h"
#include "server/http/request_reader.h"

namespace armloom {

struct Arrived {
  Request request;
  RequestHeader header;
  Delivery delivery;
  MemoryBudget::Charge charge;  // of the body
};
// The response to send if no request was read; nullopt if no client is left to answer.
using NotArrived = std::optional<Response>;

struct Terms {
  ReadTimes times;
  // Returns why the request is refused after its header, or nullopt. May be null.
  std::function<std::optional<Refusal>(const Request&)> refusal = {};
};

// Reads the next request. Releases a refused request's memory before sending the refusal, which
// takes time.
Awaitable<tl::expected<Arrived, NotArrived>> read_request(Connection& connection, const Site& site,
                                                          const Terms& terms);

}  // namespace armloom
