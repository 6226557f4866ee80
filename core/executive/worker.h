#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace armloom {

// A thread for tasks that would block the control loop or a connection thread. Tasks run one after
// the other, in the order posted. When the thread ends, tasks that have not begun are dropped. The
// caller must limit the number of waiting tasks.
class Worker {
 public:
  void post(std::function<void()> task) {
    {
      const std::scoped_lock lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    arrived_.notify_one();
  }
  // Waits for the present task, then ends the thread. The destructor does the same.
  void end() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

 private:
  void work(const std::stop_token& stop) {
    for (;;) {
      std::unique_lock lock(mutex_);
      if (!arrived_.wait(lock, stop, [this] { return !tasks_.empty(); })) return;
      const auto task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      if (stop.stop_requested()) return;
      task();
    }
  }

  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::deque<std::function<void()>> tasks_;
  std::jthread thread_{
      [this](const std::stop_token& stop) { work(stop); }};  // the last: it ends first
};

}  // namespace armloom
