#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/model/cell.h"

namespace armloom {

// A candidate for an arm's home: a position (in the order of Arm::joints, within limits), and the
// clearance that it must have from the scene and from the arms before it.
struct HomePlace {
  Eigen::VectorXd q;
  double clearance_m;  // at least the cell's
};
using HomePlaces = std::vector<std::vector<HomePlace>>;

// Two bodies that are closer than their limit with an arm at one or several of its candidates.
struct HomeObstacle {
  std::string body_a;  // of the arm
  std::string body_b;
  ArmId arm;
  std::optional<ArmId> other;  // another arm, to which body_b belongs
  bool is_self = false;        // both bodies belong to the arm
  std::size_t places = 0;      // candidates at which the two are too close
  double clearance_m = 0.0;    // the largest at these candidates
  double limit_m = 0.0;        // the cell's clearance for the two
  std::string srdf_element;    // disables the checks of the two, if is_self
};

// The chosen candidates, and what stood in the way.
struct HomeChoice {
  // Indices by arm. nullopt if kHomeChecksMax checks find no choice.
  std::optional<std::vector<std::size_t>> chosen;
  // Bodies of one robot that are too close at every candidate of an arm, whatever the other arms
  // do. `chosen` ignores them, because neither another home nor another base helps. Empty if a
  // choice without conflicts was found.
  std::vector<HomeObstacle> lasting;
  // By arm: if the first candidate was not chosen, the two bodies that are closest there with the
  // other arms at their chosen places.
  std::vector<std::optional<HomeObstacle>> at_first;
  // If `chosen` is nullopt: the most frequent obstacles of each arm that has no free candidate by
  // itself; if all arms have one, the most frequent obstacle between arms.
  std::vector<HomeObstacle> frequent;
};

// Chooses one candidate for each arm such that all arms keep their required clearances and the
// cell's self_clearance_m. Earlier candidates of earlier arms are preferred. Precondition: `places`
// has one entry per arm, and each of them a candidate. Problems: those of PlanningScene::build.
inline constexpr std::size_t kHomeChecksMax = 5'000;
[[nodiscard]] Result<HomeChoice> find_free_homes(const CellPtr& cell, const HomePlaces& places);

}  // namespace armloom
