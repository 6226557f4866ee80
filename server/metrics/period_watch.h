#pragma once

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>

namespace armloom {

// Measures how regular a periodic event is. happened() is called on one thread; any thread may read
// the metrics.
class PeriodWatch {
 public:
  struct Parts {
    prometheus::Histogram& gaps;
    prometheus::Counter& overruns;
    prometheus::Gauge& worst;
  };
  // A time of more than `overrun_periods` periods between two events is an overrun.
  PeriodWatch(Parts parts, std::chrono::duration<double> period, double overrun_periods)
      : parts_(parts), overrun_s_(period.count() * overrun_periods) {}

  // Call at each event. `scale`: present factor on the period.
  void happened(double scale) {
    const auto now = std::chrono::steady_clock::now();
    if (last_) {
      const double gap = std::chrono::duration<double>(now - *last_).count();
      parts_.gaps.Observe(gap);
      if (gap > overrun_s_ * scale) parts_.overruns.Increment();
      if (gap > parts_.worst.Value()) parts_.worst.Set(gap);
    }
    last_ = now;
  }

 private:
  Parts parts_;
  double overrun_s_;
  std::optional<std::chrono::steady_clock::time_point> last_;
};

}  // namespace armloom
