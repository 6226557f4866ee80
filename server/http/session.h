#pragma once

#include "server/http/asio.h"
#include "server/http/memory_budget.h"
#include "server/http/message.h"
#include "server/http/reserve.h"
#include "server/http/transport.h"

namespace armloom {

inline constexpr std::size_t kBodyMax = 8 * 1024 * 1024;  // beyond: 413
inline constexpr std::size_t kHeaderMax = 16 * 1024;      // beyond: 431; for trailers twice that
inline constexpr std::chrono::seconds kIdleTime{60};      // between requests of one connection
inline constexpr std::chrono::seconds kWriteTime{30};     // for a whole response, or a piece of one
// Time limit in the reserve, for each of TLS handshake, first bytes, header and body.
inline constexpr std::chrono::seconds kReserveTime{1};

// Serves one connection until it ends: requests in sequence, or one upgrade to a WebSocket. Runs on
// the server's thread. `site` and `memory` must outlive it.
Awaitable<void> serve_connection(Transport transport, const Site& site, MemoryBudget& memory);

// Serves one request of a connection in the reserve if limits never apply to it (a stop). Answers
// `why` to any other request, and to a client that sends no request in time. Then closes the
// connection.
Awaitable<void> serve_in_reserve(Transport transport, Reserve::Place& place, Refusal why,
                                 const Site& site, MemoryBudget& memory);

}  // namespace armloom
