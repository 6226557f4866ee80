#pragma once

#include <chrono>
#include <cstddef>

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

inline constexpr std::size_t kPieceSize = 64 * 1024;  // bytes of a body in memory at a time

// Sends the whole body; the header has already been sent. `time` is the limit for each piece. Sets
// `ec` if sending fails or a piece cannot be read. The response is then incomplete and the
// connection unusable.
Awaitable<void> send_pieces(Transport& stream, const PiecedBody& body,
                            std::chrono::milliseconds time, ErrorCode& ec);

}  // namespace armloom
