#include "server/http/asio.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

namespace armloom {

void spawn(const Executor& executor, Awaitable<void> task) {
  asio::co_spawn(executor, std::move(task), asio::detached);
}

}  // namespace armloom
