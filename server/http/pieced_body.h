#pragma once

#include <chrono>
#include <cstddef>

#include "server/http/asio.h"
#include "server/http/message.h"
#include "server/http/transport.h"

namespace armloom {

inline constexpr std::size_t kPieceSize = 64 * 1024;  // what is held of a PiecedBody at a time

// Sends it to its end, after the header; each piece may take so long. An error, too: a piece cannot
// be read, so that the length that was said is not reached and the connection is of no more use.
Awaitable<void> send_pieces(Transport& stream, const PiecedBody& body,
                            std::chrono::milliseconds time, ErrorCode& ec);

}  // namespace armloom
