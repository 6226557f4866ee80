#pragma once

#include "server/http/asio.h"
#include "server/http/memory_budget.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

inline constexpr std::size_t kBodyMax = 8 * 1024 * 1024;  // beyond: 413
inline constexpr std::size_t kHeaderMax = 16 * 1024;      // beyond: 431; of trailers twice that
inline constexpr std::chrono::seconds kIdleTime{60};      // between requests of one connection
inline constexpr std::chrono::seconds kWriteTime{30};     // for a whole response

// Serves one connection until it ends: requests one after the other, or one upgrade to a WebSocket.
// Runs on the server's thread; `site` and
// `memory` outlive it.
asio::awaitable<void> serve_connection(Transport transport, const Site& site, MemoryBudget& memory);

// Says `why` at once, whatever is asked, and closes.
asio::awaitable<void> refuse_connection(Transport transport, Response why, MemoryBudget& memory);

}  // namespace armloom
