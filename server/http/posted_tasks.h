#pragma once

#include <boost/asio/post.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

#include "server/http/asio.h"

namespace armloom {

// Tasks that other threads give the one that serves connections, run in the order posted, a
// millisecond's worth at a time: asio looks at sockets only when all that was ready before has run,
// and thousands of events of one batch would keep a stop waiting there. How many wait is bounded by
// who posts them.
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
  bool has_turn_ = false;  // a turn is coming or under way
};

}  // namespace armloom
