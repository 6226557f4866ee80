#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/collision/diagram/reach_check.h"
#include "core/collision/state/clearance_query.h"
#include "core/executive/authority_gate.h"
#include "core/monitor/look_ahead.h"
#include "core/monitor/premises.h"
#include "core/monitor/present.h"

namespace armloom {

// Runs the monitor on the measured state, at the monitor's rate.
class StateWatch {
 public:
  // Pairs of links that are farther apart are not in near().
  inline static constexpr double kHorizon_m = 2.0;
  // Distances for near() take most of the monitor's time. They are measured in every period, but
  // not more often than this if the period is shorter than kShortPeriod.
  inline static constexpr Duration kNearPeriod = std::chrono::milliseconds(20);
  inline static constexpr Duration kShortPeriod = std::chrono::milliseconds(10);

  StateWatch(CellPtr cell, const PlanningScenePtr& scene);
  [[nodiscard]] static ClearanceQuery query_of(const PlanningScenePtr& scene);
  // Call when the scene has changed: the next check then runs even if no arm has moved. Swaps the
  // query with the present one.
  void follow(ClearanceQuery& query, PlanningScenePtr scene);

  [[nodiscard]] bool is_due(TimePoint now);
  // Checks the premises, and returns the new findings.
  [[nodiscard]] std::vector<MonitorFinding> check_premises(const Observation& seen) {
    return premises_.check(seen);
  }
  void resumed(ArmId arm) { premises_.resumed(arm); }
  [[nodiscard]] const PremiseCheck& premises() const { return premises_; }
  // Checks the measured distances, and returns true. Does nothing and returns false if `measured`
  // has not changed since the previous call. `moving`: by ArmId.
  bool look(const Configuration& measured, const std::vector<bool>& moving, TimePoint now);
  // Predicts which arms will come too close, and which must stop now; returns the new findings.
  // Costs nothing while the premises hold and the guard certifies all motions. `stopping`: by
  // ArmId, arms that are stopped anyway. Call after check_premises().
  [[nodiscard]] std::vector<MonitorFinding> look_ahead(const Observation& seen,
                                                       const std::vector<bool>& stopping,
                                                       const AuthorityGate& gate);
  // Results of the last look() at a changed state.
  [[nodiscard]] const ClearanceQuery::Closest& near() const { return near_.pairs; }
  [[nodiscard]] const std::vector<MonitorFinding>& found() const { return found_; }

 private:
  Duration period_;
  TimePoint due_{};
  ClearanceQuery query_;
  PremiseCheck premises_;
  PresentCheck present_;
  LookAhead look_ahead_;
  PlanningScenePtr scene_;
  std::unique_ptr<ReachCheck> reaches_;  // in scene_; made on first use
  Configuration seen_;
  struct Near {
    ClearanceQuery::Closest pairs;
    TimePoint due{};
    bool is_current = false;
  };
  Near near_;
  std::vector<MonitorFinding> found_;
};

// "left_hand and right_link5 at 0.0040 m, limit 0.0100 m"
[[nodiscard]] std::string sentence(const MonitorFinding& finding, const Cell& cell);

}  // namespace armloom
