#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace armloom {

// A closed-off inbox: posted by any thread, taken whole by the one that owns it.
template <class Item>
class Inbox {
 public:
  void post(Item item) {
    {
      const std::scoped_lock lock(mutex_);
      items_.push_back(std::move(item));
    }
    arrived_.notify_one();
  }
  // Waits until something arrives, `until`, or a stop request; returns all that has arrived.
  std::deque<Item> take(std::stop_token stop, std::chrono::steady_clock::time_point until) {
    std::unique_lock lock(mutex_);
    arrived_.wait_until(lock, stop, until, [this] { return !items_.empty(); });
    return std::exchange(items_, {});
  }
  std::deque<Item> take(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, stop, [this] { return !items_.empty(); });
    return std::exchange(items_, {});
  }
  // What has arrived.
  std::deque<Item> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(items_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::deque<Item> items_;
};

// A thread with an inbox: does one item after the other until it is told to end, or destroyed.
template <class Item>
class Worker {
 public:
  using Work = std::function<void(Item&, std::stop_token)>;

  void run(Work work) {
    thread_ = std::jthread([this, work = std::move(work)](std::stop_token stop) {
      while (!stop.stop_requested()) {
        for (Item& item : inbox_.take(stop)) {
          if (stop.stop_requested()) return;
          work(item, stop);
        }
      }
    });
  }
  void post(Item item) { inbox_.post(std::move(item)); }
  void end() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

 private:
  Inbox<Item> inbox_;
  std::jthread thread_;
};

}  // namespace armloom
