#pragma once

// Include asio only through this header: awaitable.hpp of Boost 1.74 forgets <utility>.
// clang-format off: first of all
#include <utility>
// clang-format on

#include <boost/asio/awaitable.hpp>
#include <boost/asio/basic_stream_socket.hpp>
#include <boost/asio/basic_waitable_timer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>

#include "server/http/error_code.h"

namespace armloom {

namespace asio = boost::asio;

// Asio types with the concrete executor of io_context, because any_io_executor takes longer to
// compile.
using Executor = asio::io_context::executor_type;
using Timer = asio::basic_waitable_timer<std::chrono::steady_clock,
                                         asio::wait_traits<std::chrono::steady_clock>, Executor>;
using Socket = asio::basic_stream_socket<asio::ip::tcp, Executor>;
template <class Value>
using Awaitable = asio::awaitable<Value, Executor>;

// Completion token: the operation's error goes into `ec` instead of being thrown.
inline auto into(ErrorCode& ec) {
  return asio::redirect_error(asio::use_awaitable_t<Executor>(), ec);
}

// Returns at once. `task` then starts on the executor's thread. Exceptions that leave `task` are
// dropped.
void spawn(const Executor& executor, Awaitable<void> task);

}  // namespace armloom
