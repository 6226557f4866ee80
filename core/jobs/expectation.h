#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/precedence/coordinated_motion.h"
#include "core/precedence/prediction.h"

namespace armloom {

// Where everything admitted was expected to be, and when, as its orders were chosen last. Pure.
class Expectation {
 public:
  // The prediction is of these motions.
  void renew(const std::vector<CoordinatedMotion>& motions, const Prediction& prediction,
             TimePoint now);
  // Since then something was taken back.
  void spoil() { is_spoilt_ = true; }
  // Some motion is farther from where it was to be now than motions are by themselves, or orders
  // were chosen for others.
  [[nodiscard]] bool is_missed(const std::vector<CoordinatedMotion>& motions, TimePoint now) const;

 private:
  struct Way {
    std::vector<Prediction::Stage> stages;
    double pace;
  };
  [[nodiscard]] static Duration progress_at(const Way& way, Duration time);

  std::map<JobId, Way> expected_;
  TimePoint at_{};
  bool is_spoilt_ = false;
};

}  // namespace armloom
