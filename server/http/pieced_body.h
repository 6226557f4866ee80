#pragma once

#include <chrono>
#include <cstddef>

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

inline constexpr std::size_t kPieceSize = 64 * 1024;  // in memory at a time

// Sends the whole body, after the header. `time` limits each piece. After an error, also if a piece
// cannot be read, the response is incomplete and the connection unusable.
Awaitable<void> send_pieces(Transport& stream, const PiecedBody& body,
                            std::chrono::milliseconds time, ErrorCode& ec);

}  // namespace armloom
