#pragma once

#include <vector>

#include "core/collision/state/clearance_query.h"
#include "core/monitor/monitor.h"

namespace armloom {

// Looks at the measured state as often as the monitor's rate says: what is near, and what is too
// close.
class StateWatch {
 public:
  // What is farther apart than this is not told in state frames nor counted as near.
  inline static constexpr double kHorizon_m = 2.0;

  explicit StateWatch(const PlanningScenePtr& scene);
  // With the monitor's limits.
  [[nodiscard]] static ClearanceQuery query_of(const PlanningScenePtr& scene);
  // The scene is another one: looks again, though no arm has moved.
  void follow(ClearanceQuery query);

  // Once for each period.
  [[nodiscard]] bool is_due(TimePoint now);
  // Whether the state is another one than that of the last look. `moving`: by ArmId.
  bool look(const Configuration& measured, const std::vector<bool>& moving, TimePoint now);
  // Of the last look at another state:
  [[nodiscard]] const std::vector<Proximity>& near() const { return near_; }
  [[nodiscard]] const std::vector<MonitorFinding>& found() const { return found_; }

 private:
  Duration period_;
  TimePoint due_{};
  ClearanceQuery query_;
  Monitor monitor_;
  Configuration seen_;
  std::vector<Proximity> near_;
  std::vector<MonitorFinding> found_;
};

// "monitor: left_hand and right_link5 at 0.0040 m, limit 0.0100 m"
[[nodiscard]] std::string sentence(const MonitorFinding& finding);

}  // namespace armloom
