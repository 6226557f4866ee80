#pragma once

#include <boost/beast/core/flat_buffer.hpp>
#include <string>

#include "server/http/asio.h"
#include "server/http/memory_budget.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

// What is read ahead: a whole header, or a piece of a body with the chunk line or the trailers that
// stand before it. More than that of them is refused.
inline constexpr std::size_t kBufferMax = 32 * 1024;

// One connection, with what its requests share.
struct Connection {
  Connection(Transport transport, MemoryBudget& budget)
      : stream(std::move(transport)), memory(budget) {}
  Transport stream;
  boost::beast::flat_buffer buffer{kBufferMax};
  MemoryBudget& memory;
  std::string request_id = {};  // of the request that is read or answered
};

// How an answer stands on the wire, as the request wants it.
struct Delivery {
  unsigned version = 11;
  bool keep_alive = false;
  bool without_body = false;  // of a HEAD
};

// Sends a whole answer, with the headers that every answer has; a time limit is on it.
Awaitable<void> send(Connection& connection, Response response, Delivery delivery, ErrorCode& ec);

// Ends a connection so that the peer can still read the answer.
Awaitable<void> linger(Connection& connection);

// Says why, and ends the connection.
Awaitable<void> refuse(Connection& connection, Response why);

}  // namespace armloom
