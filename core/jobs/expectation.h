#pragma once

#include <map>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/precedence/coordinated_motion.h"
#include "core/precedence/prediction.h"

namespace armloom {

// The progress of all admitted motions that was predicted when their orders were last chosen. Pure.
class Expectation {
 public:
  // Stores a prediction for these motions.
  void renew(const std::vector<CoordinatedMotion>& motions, const Prediction& prediction,
             TimePoint now);
  // A motion was abandoned: the expectation is void until the next renew().
  void spoil() { is_spoilt_ = true; }
  // Returns true if a motion's progress is more than 0.4 s off its expectation, or if the
  // expectation is void.
  [[nodiscard]] bool is_missed(const std::vector<CoordinatedMotion>& motions, TimePoint now) const;

 private:
  struct Way {
    std::vector<Prediction::Stage> stages;
    double pace;
  };
  [[nodiscard]] static Duration progress_at(const Way& way, Duration time);

  std::map<StepId, Way> expected_;
  TimePoint at_{};
  bool is_spoilt_ = false;
};

}  // namespace armloom
