#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <string>

#include "server/http/asio.h"
#include "server/http/memory_budget.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

// Size of the read buffer in bytes. A whole header, a chunk line and all trailers must each fit
// into it.
inline constexpr std::size_t kBufferMax = 32 * 1024;

struct Connection {
  Connection(Transport transport, MemoryBudget& budget)
      : stream(std::move(transport)), memory(budget) {}
  Transport stream;
  boost::beast::flat_buffer buffer{kBufferMax};
  MemoryBudget& memory;
  std::string request_id = {};  // of the current request
};

// How the request wants its response to be sent.
struct Delivery {
  unsigned version = 11;
  bool keep_alive = false;
  bool without_body = false;  // for HEAD
};

// Sends a whole response with the common headers, within a time limit.
Awaitable<void> send(Connection& connection, Response response, Delivery delivery, ErrorCode& ec);

// Ends a connection so that the client can still read the response.
Awaitable<void> linger(Connection& connection);

Awaitable<void> refuse(Connection& connection, Response why);

}  // namespace armloom
