#include "core/monitor/moves_on.h"

#include <algorithm>

namespace armloom {

void MovesOn::begin(TimePoint from) {
  stands_from_ = from;
  windows_.clear();
  reports_ = 0;
}

bool MovesOn::observe(const Configuration& measured, const std::vector<JointId>& joints,
                      double margin, TimePoint now) {
  if (!stands_from_ || now < *stands_from_) return false;
  if (reports_++ == 0) {
    window_began_ = now;
    windows_.emplace_back();
    for (const JointId joint : joints) {
      windows_.back().push_back({measured[joint.value()], measured[joint.value()]});
    }
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    Range& range = windows_.back()[j];
    range.low = std::min(range.low, measured[joints[j].value()]);
    range.high = std::max(range.high, measured[joints[j].value()]);
  }
  if (reports_ < kReports || now - window_began_ < kWindow) return false;
  reports_ = 0;
  if (windows_.size() < kWindows) return false;
  end();
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (moved_on(j, margin)) return true;
  }
  return false;
}

bool MovesOn::moved_on(std::size_t joint, double margin) const {
  bool rises = true, falls = true;
  for (std::size_t w = 2; w < windows_.size(); ++w) {
    const Range &before = windows_[w - 2][joint], &now = windows_[w][joint];
    rises = rises && now.low > before.high + margin;
    falls = falls && now.high < before.low - margin;
  }
  return rises || falls;
}

}  // namespace armloom
