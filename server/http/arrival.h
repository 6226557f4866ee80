#pragma once

#include <functional>
#include <optional>

#include "server/http/connection.h"
#include "server/http/request_head.h"
#include "server/http/request_reader.h"

namespace armloom {

// A request as it was read, with what its answer needs.
struct Arrived {
  Request request;
  RequestHeader header;
  Delivery delivery;
  MemoryBudget::Charge charge;  // of the body
};
// Why there is none, to be said; absent: there is nobody to say it to.
using NotArrived = std::optional<Response>;

// How a request is read.
struct Terms {
  ReadTimes times;
  // Why it is not served, as is known by its header; null: nothing is refused so.
  std::function<std::optional<Refusal>(const Request&)> refusal = {};
};

// The next request of the connection. What was read of one that is refused is forgotten before the
// refusal can be said: that takes time.
Awaitable<tl::expected<Arrived, NotArrived>> read_request(Connection& connection, const Site& site,
                                                          const Terms& terms);

}  // namespace armloom
