#pragma once

#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/model/cell_description.h"
#include "test/scenarios/random_faults.h"

namespace armloom {

// Returns three or four arms that cross each other (star, polygon or ladder) with random settings.
[[nodiscard]] CellDescription team_cell(Random& random);

// Records all events and the smallest distances between balls.
struct WatchedTeam final : Observer {
  explicit WatchedTeam(const CellDescription& cell);
  void on_event(const Event& event) override;
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint now, const Configuration& measured) override;
  [[nodiscard]] Eigen::Vector3d center(std::size_t arm) const;

  std::vector<Eigen::Isometry3d> X_WB;
  std::vector<std::string> names;
  std::vector<std::vector<bool>> in_step;  // true if the last motion of both arms was the same
  std::vector<Event> events;
  Configuration last;
  double smallest_m = 1e9, smallest_in_step_m = 1e9;
  TimePoint when{}, when_in_step{}, moved_at{};
};

}  // namespace armloom
