#pragma once

#include <vector>

#include "core/collision/state/clearance_query.h"
#include "core/monitor/monitor.h"

namespace armloom {

// Runs the monitor on the measured state, at the monitor's rate.
class StateWatch {
 public:
  // Pairs of links that are farther apart are not in near().
  inline static constexpr double kHorizon_m = 2.0;

  explicit StateWatch(const PlanningScenePtr& scene);
  [[nodiscard]] static ClearanceQuery query_of(const PlanningScenePtr& scene);
  // Call when the scene has changed: the next check then runs even if no arm has moved. Swaps the
  // query with the present one.
  void follow(ClearanceQuery& query);

  [[nodiscard]] bool is_due(TimePoint now);
  // Checks `measured`, and returns true. Does nothing and returns false if `measured` has not
  // changed since the previous call. `moving`: by ArmId.
  bool look(const Configuration& measured, const std::vector<bool>& moving, TimePoint now);
  // Results of the last check of a changed state.
  [[nodiscard]] const ClearanceQuery::Closest& near() const { return near_; }
  [[nodiscard]] const std::vector<MonitorFinding>& found() const { return found_; }

 private:
  Duration period_;
  TimePoint due_{};
  ClearanceQuery query_;
  Monitor monitor_;
  Configuration seen_;
  ClearanceQuery::Closest near_;
  std::vector<MonitorFinding> found_;
};

// "monitor: left_hand and right_link5 at 0.0040 m, limit 0.0100 m"
[[nodiscard]] std::string sentence(const MonitorFinding& finding);

}  // namespace armloom
