#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/model/cell_description.h"

namespace armloom {

// Crowded worlds with a known solution: discs of 10 cm radius in one plane, each on two linear
// axes, that block each other. Places are in meters.

inline constexpr double kDiscDistance_m = 0.2;  // between two centers in contact
// Distances between centers that solutions keep. They are larger than contact, clearance and
// tracking error together.
inline constexpr double kKeptOneByOne_m = 0.26;
inline constexpr double kKeptTogether_m = 0.28;

enum class Crowd {
  swap,    // two discs exchange places
  ring3,   // three discs, each moves to the next one's place
  ring4,   // the same with four
  queues,  // two to four discs with two or three jobs each, all crossing
  parked,  // one disc rests for good where others must pass or go
};
inline constexpr Crowd kCrowds[] = {Crowd::swap, Crowd::ring3, Crowd::ring4, Crowd::queues,
                                    Crowd::parked};
[[nodiscard]] const char* to_string(Crowd crowd);

// A motion along straight segments, at rest at every waypoint. All segments have the same time law.
struct DiscMotion {
  std::size_t arm;
  std::vector<Eigen::Vector2d> way;  // from the current place; at least two
  std::vector<double> times_s;       // of each waypoint, from zero
  bool of_a_client = true;           // false: a retreat that no client requests
  [[nodiscard]] Eigen::Vector2d at(double time_s) const;
  [[nodiscard]] double duration_s() const { return times_s.back(); }
};

struct CrowdedWorkload {
  Crowd crowd;
  std::uint64_t seed;
  std::vector<Eigen::Vector2d> homes;  // by arm: its first place
  // The solution: groups of motions, one group after the other. Motions of one group start
  // together.
  std::vector<std::vector<DiscMotion>> solution;
  // The client motions of the solution as they are submitted: all at once with arms in another
  // order, or in the solution's order with delays. Each arm keeps the order of its motions.
  struct Submitted {
    double at_s;
    DiscMotion motion;
    std::vector<std::size_t> after;  // indices of its predecessors
  };
  std::vector<Submitted> submitted;

  [[nodiscard]] CellDescription cell() const;
  [[nodiscard]] std::vector<TimedJob> jobs() const;  // keys: "<arm><n>", n from 1
};

// Records the smallest distance between any two discs at every tick.
struct ClosestDiscs final : Observer {
  void on_event(const Event&) override {}
  void on_state(const StateFrame&) override {}
  void on_tick(TimePoint now, const Configuration& measured) override {
    for (Eigen::Index i = 0; i < measured.size(); i += 2) {
      for (Eigen::Index j = 0; j < i; j += 2) {
        const double apart_m =
            (measured.segment<2>(i) - measured.segment<2>(j)).norm() - kDiscDistance_m;
        if (apart_m < smallest_m) smallest_m = apart_m, when = now;
      }
    }
  }
  double smallest_m = 1e9;
  TimePoint when{};
};

// Returns the arm's name: "a", "b", ...
[[nodiscard]] std::string disc_name(std::size_t arm);

// Deterministic in its arguments. Throws std::runtime_error if no workload is found (never seen).
[[nodiscard]] CrowdedWorkload make_crowded(Crowd crowd, std::uint64_t seed);

// Returns the smallest distance between any two centers during the solution, by plain geometry at 1
// ms. For groups of several motions the difference kKeptTogether_m - kKeptOneByOne_m is subtracted.
// At least kKeptOneByOne_m for every result of make_crowded().
[[nodiscard]] double smallest_kept_m(const CrowdedWorkload& workload);

}  // namespace armloom
