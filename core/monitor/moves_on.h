#pragma once

#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/model/cell.h"

namespace armloom {

// Tells an arm that moves on after a brake from an arm that stands and is measured with noise. The
// reports after the brake are divided into kWindows windows. A joint moves on if all its positions
// in each window are beyond those in the window before the last one, in one direction, by more than
// a margin.
//
// If the reports of a standing joint are independent, with any distribution of their noise, this
// happens by chance with a probability below 1 / C(2 n, n) for each direction, n = kReports: 1e-11.
// A vibration is no motion. An arm counts as standing if its joints are slower than (margin + span
// of the noise) / kWindow, or if it stands for 2 kWindow. Pure; not thread-safe.
class MovesOn {
 public:
  inline static constexpr Duration kWindow = std::chrono::milliseconds(300);
  inline static constexpr std::size_t kWindows = 5;
  inline static constexpr int kReports = 20;  // fewest in a window

  // The arm must stand from `from` on.
  void begin(TimePoint from);
  void end() { stands_from_.reset(); }
  // Takes a new report. Returns true at the end of the last window, if a joint moved on. Returns
  // false if begin() was not called, and after the last window.
  [[nodiscard]] bool observe(const Configuration& measured, const std::vector<JointId>& joints,
                             double margin, TimePoint now);

 private:
  struct Range {
    double low, high;
  };
  [[nodiscard]] bool moved_on(std::size_t joint, double margin) const;
  std::optional<TimePoint> stands_from_;
  std::vector<std::vector<Range>> windows_;  // the last one is open; by position in `joints`
  int reports_ = 0;                          // in the open window
  TimePoint window_began_{};
};

}  // namespace armloom
