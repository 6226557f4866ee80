#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/coordination/proximity.h"
#include "core/coordination/reach.h"
#include "core/monitor/finding.h"
#include "core/monitor/observation.h"
#include "core/monitor/premises.h"
#include "core/monitor/stop_set.h"

namespace armloom {

// Answers questions about the geometry of the cell. May only err on the side of "too close".
class ReachGeometry {
 public:
  virtual ~ReachGeometry() = default;
  // Return evidence if two arms, or an arm and the scene, may come closer than stop_clearance_m.
  [[nodiscard]] virtual std::optional<Proximity> may_meet(const Reach& a, const Reach& b) = 0;
  [[nodiscard]] virtual std::optional<Proximity> may_meet_scene(const Reach& reach) = 0;
};

// The proofs that certificates give for the present positions up to the arms' authority.
class CertifiedPairs {
 public:
  virtual ~CertifiedPairs() = default;
  [[nodiscard]] virtual bool certifies(ArmId a, ArmId b) const = 0;
  [[nodiscard]] virtual bool certifies_scene(ArmId arm) const = 0;
};

// Predicts which arms will come too close unless an arm stops now, and finds the smallest set of
// arms whose stop prevents it (README.md). Pairs that are certified cost nothing. For the others,
// each arm is compared where it can get if
// - it brakes now, or
// - it goes on for one more period and brakes then.
// So an arm is stopped when the next period would be too late. Pure; not thread-safe.
class LookAhead {
 public:
  // `period`: of the monitor.
  LookAhead(CellPtr cell, Duration period);

  // `stopping`: by ArmId, arms that other findings of this period stop. `premises`: after the check
  // of this period. A conflict is reported when it was not predicted for kSameCondition, and
  // whenever it stops an arm. Each finding names the arms that are stopped for it.
  [[nodiscard]] std::vector<MonitorFinding> check(const Observation& seen,
                                                  const PremiseCheck& premises,
                                                  const std::vector<bool>& stopping,
                                                  const CertifiedPairs& certified,
                                                  ReachGeometry& geometry);

  struct ArmReach {
    Reach braking;
    Reach going;
    bool may_go_on = false;  // a stop now makes a difference
    bool is_still = true;    // neither moves nor may move
  };
  // Returns the reaches of an arm. `is_stopping`: it is stopped in this period. Precondition:
  // `premises` have checked `seen`.
  [[nodiscard]] ArmReach reach_of(ArmId arm, const Observation& seen, const PremiseCheck& premises,
                                  bool is_stopping);

 private:
  using Conflicting = std::pair<ArmId, std::optional<ArmId>>;
  struct Predicted {
    StopConflict conflict;
    Proximity evidence;
    std::optional<ArmId> other;  // also if a stop does not affect it
    bool can_be_resolved = false;
  };
  void compare(ArmId a, ArmId b, const std::vector<ArmReach>& reaches, ReachGeometry& geometry,
               std::vector<Predicted>& predicted) const;

  CellPtr cell_;
  Duration period_;
  struct OffPath {
    Configuration shift;     // measured distance of each joint from the path
    Configuration velocity;  // of the shift, or of a joint without a path
  };
  std::vector<std::optional<OffPath>> off_path_;  // by ArmId; of the last period
  struct Pace {
    TrajectoryPtr motion;
    Duration commanded{};
    ReportTime reported;
    std::optional<double> rate = {};  // nullopt: any
  };
  // `elapsed`: since the report before; nullopt if there is no new one. `overdue`: a report that is
  // older.
  [[nodiscard]] std::optional<double> rate_of(const ArmObservation& now,
                                              std::optional<Duration> elapsed, Duration overdue,
                                              Pace& pace) const;
  std::vector<Pace> paces_;                 // by ArmId; of the last period
  std::map<Conflicting, TimePoint> known_;  // when each was predicted last
};

}  // namespace armloom
