#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/collision/planning_scene.h"
#include "core/coordination/verdict.h"
#include "core/model/cell.h"

namespace armloom {

// Asks one scene about single configurations of the whole cell. Holds the scratch: one per worker
// thread, not thread-safe. FCL that throws counts as contact (clearance 0).
class CollisionChecker {
 public:
  explicit CollisionChecker(PlanningScenePtr scene);
  ~CollisionChecker();

  [[nodiscard]] const PlanningScene& scene() const;

  // The first pair found that is closer than `clearance_m` and involves a link moved by one of
  // `arms` (indexed by ArmId; true: look at it): against other arms, static links, itself and the
  // objects. Not the closest: the scene's pair order, so that it is deterministic. Nullopt: none.
  [[nodiscard]] std::optional<Proximity> first_closer_than(const Configuration& q,
                                                           double clearance_m,
                                                           const std::vector<bool>& arms);

  // Every pair (allowed ones left out) closer than `clearance_m`, as above: the closest of each
  // pair of arms, of each arm with the objects and static links, and of each arm with itself.
  [[nodiscard]] std::vector<Proximity> all_closer_than(const Configuration& q, double clearance_m);

  // The closest pair of links for each pair of different arms, exact when below `horizon_m`;
  // pairs farther apart are left out.
  [[nodiscard]] std::vector<Proximity> closest_between_arms(const Configuration& q,
                                                            double horizon_m);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace armloom
