#pragma once

#include <boost/asio/post.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

#include "server/http/asio.h"

namespace armloom {

// Tasks of other threads for the server's thread. Runs them in order, about a millisecond at a
// time: asio polls sockets only when all ready handlers have run, so thousands of tasks in a row
// would delay a stop. Callers must limit the queue.
class PostedTasks {
 public:
  using Task = std::function<void()>;

  explicit PostedTasks(asio::io_context& io) : io_(io) {}

  void post(Task task) {
    const std::scoped_lock lock(mutex_);
    tasks_.push_back(std::move(task));
    if (!std::exchange(has_turn_, true)) take_turn();
  }

 private:
  inline static constexpr std::chrono::milliseconds kTurn{1};

  void take_turn() {
    asio::post(io_, [this] { run_some(); });
  }

  void run_some() {
    const auto until = std::chrono::steady_clock::now() + kTurn;
    do {
      Task task;
      {
        const std::scoped_lock lock(mutex_);
        has_turn_ = !tasks_.empty();
        if (!has_turn_) return;
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
      task();
    } while (std::chrono::steady_clock::now() < until);
    take_turn();
  }

  asio::io_context& io_;
  std::mutex mutex_;
  std::deque<Task> tasks_;
  bool has_turn_ = false;  // run_some() is posted or running
};

}  // namespace armloom
