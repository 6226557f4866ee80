#pragma once

// The one way in which asio is included: awaitable.hpp of Boost 1.74 forgets <utility>.
// clang-format off: first of all
#include <utility>
// clang-format on

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>

#include "server/http/error_code.h"

namespace armloom {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;

// Completion token: the operation's error goes into `ec` instead of being thrown.
inline auto into(ErrorCode& ec) { return asio::redirect_error(asio::use_awaitable, ec); }

}  // namespace armloom
