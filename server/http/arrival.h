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
// Result of read_request() if no request can be handled: the response to send, or nullopt if the
// client disconnected or sent nothing.
using NotArrived = std::optional<Response>;

struct Terms {
  ReadTimes times;
  // Returns why the request is refused after its header, or nullopt. May be null.
  std::function<std::optional<Refusal>(const Request&)> refusal = {};
};

// Reads the next request. Does not send a refusal itself: it returns the refusal, so that the
// refused request's memory is released before the caller sends it.
Awaitable<tl::expected<Arrived, NotArrived>> read_request(Connection& connection, const Site& site,
                                                          const Terms& terms);

}  // namespace armloom
