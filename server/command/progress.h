#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace armloom {

// Shows on a terminal that a command is at work: one line on stderr, which is updated twice a
// second and removed at the end. Nothing is shown in the first two seconds, or if stderr is not a
// terminal. Thread-safe.
class Progress {
 public:
  // `what`: what is done, such as "reach".
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void share(double done) { share_ = done; }         // 0 to 1
  void cell_time(double now_s) { cell_s_ = now_s; }  // of a simulation
  // Begins part `number` of `count`.
  void part(std::size_t number, std::size_t count) {
    parts_ = count;
    part_ = number;
    cell_s_ = -1.0;
  }

  // Returns the line at this time: "armloom: reach: 42 %, 12 s".
  [[nodiscard]] std::string line(std::chrono::seconds elapsed) const;

 private:
  void show(const std::stop_token& stop) const;

  const std::string what_;
  std::atomic<double> share_{-1.0};  // negative: unknown
  std::atomic<double> cell_s_{-1.0};
  std::atomic<std::size_t> part_{0}, parts_{0};
  std::jthread thread_;  // not started without a terminal
};

}  // namespace armloom
