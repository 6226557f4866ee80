#pragma once

#include <optional>
#include <vector>

#include "core/base/problem.h"
#include "core/coordination/proximity.h"
#include "core/model/cell.h"

namespace armloom {

// The costs of the promises of an arm's controller.
struct PromiseReport {
  // A distance at home, and an upper bound for all joint positions within the limits.
  struct Distance {
    double home_m = 0.0;
    double max_m = 0.0;
  };
  ArmId arm;
  double tracking_error = 0.0;  // rad, m
  // How far a point of the arm may be from where the path has it: the sum, over the joints that
  // move the point, of tracking_error times the joint's lever. Other bodies must be farther away by
  // this much.
  Distance inflation = {};
  // Longest time from a brake command until a joint at full speed rests: reaction + velocity /
  // brake.
  double stopping_s = 0.0;
  // How far a point of the arm moves in this time, if one joint moves at full speed; and the part
  // of it before the brake begins.
  Distance stopping = {};
  Distance reaction = {};
  // How far authority reaches beyond the stopping distance (trajectory time).
  Duration horizon{};
  // How far an arm of a synchronous motion may lead, without the stopping reach (trajectory time).
  Duration lead{};
  // A pair that keeps its clearance with the arm at home, but not if joints deviate as promised; or
  // nullopt.
  std::optional<Proximity> too_close_at_home = {};
};

// Returns a report for each arm, in the cell's order. Problems: those of PlanningScene::build.
[[nodiscard]] Result<std::vector<PromiseReport>> report_promises(const CellPtr& cell);

}  // namespace armloom
