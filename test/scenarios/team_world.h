#pragma once

#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/model/cell_description.h"
#include "test/scenarios/random_faults.h"

namespace armloom {

// Three or four arms that cross each other: a star, a polygon or a ladder, with settings of any
// kind.
[[nodiscard]] CellDescription team_cell(Random& random);

// Everything that is told, and how near the balls have come.
struct WatchedTeam final : Observer {
  explicit WatchedTeam(const CellDescription& cell);
  void on_event(const Event& event) override;
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint now, const Configuration& measured) override;
  [[nodiscard]] Eigen::Vector3d center(std::size_t arm) const;

  std::vector<Eigen::Isometry3d> X_WB;
  std::vector<std::string> names;
  std::vector<std::vector<bool>> in_step;  // the last motion of both was the same
  std::vector<Event> events;
  Configuration last;
  double smallest_m = 1e9, smallest_in_step_m = 1e9;
  TimePoint when{}, when_in_step{}, moved_at{};
};

}  // namespace armloom
