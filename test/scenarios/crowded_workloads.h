#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/executive/simulation.h"
#include "core/model/cell_description.h"

namespace armloom {

// Crowded worlds with a known solution: discs of 10 cm radius in one plane, each carried by two
// linear axes, who are in each other's way. Places are in metres.

inline constexpr double kDiscDistance_m = 0.2;  // of two centres, in contact
// What solutions keep between centres: more than contact, clearance and tracking error together.
inline constexpr double kKeptOneByOne_m = 0.26;
inline constexpr double kKeptTogether_m = 0.28;

enum class Crowd {
  swap,    // two exchange their places
  ring3,   // three, each goes where the next one stands
  ring4,   // four
  queues,  // two to four with two or three jobs each, all across each other
  parked,  // one has come to rest for good where others have to pass or to go
};
inline constexpr Crowd kCrowds[] = {Crowd::swap, Crowd::ring3, Crowd::ring4, Crowd::queues,
                                    Crowd::parked};
[[nodiscard]] const char* to_string(Crowd crowd);

// Straight legs, at rest at every waypoint; all legs of the same law.
struct DiscMotion {
  std::size_t arm;
  std::vector<Eigen::Vector2d> way;  // from where it stands; at least two
  std::vector<double> times_s;       // of each waypoint, from zero
  bool of_a_client = true;           // else a move aside that nobody asks for
  [[nodiscard]] Eigen::Vector2d at(double time_s) const;
  [[nodiscard]] double duration_s() const { return times_s.back(); }
};

struct CrowdedWorkload {
  Crowd crowd;
  std::uint64_t seed;
  std::vector<Eigen::Vector2d> homes;  // by arm: where it stands at first
  // The solution: groups of motions, one group after the other; those of one group begin together.
  std::vector<std::vector<DiscMotion>> solution;
  // The clients' motions of it as they are submitted: another order between the arms at the same
  // instant, or the solution's order with pauses between. Each arm's own order is kept.
  struct Submitted {
    double at_s;
    DiscMotion motion;
    std::vector<std::size_t> after;  // indices of those that have to succeed before it
  };
  std::vector<Submitted> submitted;

  [[nodiscard]] CellDescription cell() const;
  [[nodiscard]] std::vector<TimedJob> jobs() const;  // keys: "<arm><n>", n from 1
};

// The smallest distance between any two discs, as measured at every tick.
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

// The arm's name: "a", "b", ...
[[nodiscard]] std::string disc_name(std::size_t arm);

// The same for the same seed. Throws std::runtime_error when no workload is found (never seen).
[[nodiscard]] CrowdedWorkload make_crowded(Crowd crowd, std::uint64_t seed);

// The smallest distance between any two centres while the solution is executed, found with plain
// geometry at 1 ms; minus what is missing to kKeptTogether_m where groups of several move.
// At least kKeptOneByOne_m for what make_crowded gives.
[[nodiscard]] double smallest_kept_m(const CrowdedWorkload& workload);

}  // namespace armloom
