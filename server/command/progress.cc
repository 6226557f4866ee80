#include "server/command/progress.h"

#include <unistd.h>

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <utility>

namespace armloom {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kSilent{2};
constexpr std::chrono::milliseconds kPeriod{500};
constexpr const char* kClear = "\r\033[K";

}  // namespace

Progress::Progress(std::string what) : what_(std::move(what)) {
  if (isatty(STDERR_FILENO) == 0) return;
  thread_ = std::jthread([this](const std::stop_token& stop) { show(stop); });
}

Progress::~Progress() = default;

std::string Progress::line(std::chrono::seconds elapsed) const {
  std::string text = "armloom: " + what_ + ": ";
  char figures[64];
  if (parts_ > 0) {
    std::snprintf(figures, sizeof figures, "%zu of %zu, ", part_.load(), parts_.load());
    text += figures;
  }
  if (share_ >= 0.0) {
    std::snprintf(figures, sizeof figures, "%.0f %%, ", 100.0 * share_);
    text += figures;
  }
  if (cell_s_ >= 0.0) {
    std::snprintf(figures, sizeof figures, "%.0f s of cell time, ", cell_s_.load());
    text += figures;
  }
  return text + std::to_string(elapsed.count()) + " s";
}

void Progress::show(const std::stop_token& stop) const {
  const auto begun = Clock::now();
  std::mutex mutex;
  std::condition_variable_any ended;
  std::unique_lock lock(mutex);
  bool is_shown = false;
  auto pause = std::chrono::duration_cast<Clock::duration>(kSilent);
  while (!ended.wait_for(lock, stop, pause, [&] { return stop.stop_requested(); })) {
    const auto elapsed = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - begun);
    // The cursor stays in the first column, so that another message replaces the line.
    std::fprintf(stderr, "%s%s\r", kClear, line(elapsed).c_str());
    is_shown = true;
    pause = kPeriod;
  }
  if (is_shown) std::fputs(kClear, stderr);
}

}  // namespace armloom
