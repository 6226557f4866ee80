#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "test/scenarios/crowded_workloads.h"
#include "test/scenarios/random_faults.h"

namespace armloom {

using Place = Eigen::Vector2d;
using Way = std::vector<Place>;

[[nodiscard]] double distance_to_leg(const Place& point, const Place& from, const Place& to);
// Returns a motion along straight segments at the given speed, with at least 0.4 s for each
// segment.
[[nodiscard]] DiscMotion disc_motion(std::size_t arm, Way way, double speed_m_s);

// A square area with discs at rest. Finds free places, and paths for one disc among the others.
class DiscRoom {
 public:
  explicit DiscRoom(std::uint64_t seed) : random_(seed) {}

 protected:
  inline static constexpr int kTries = 2000;

  [[nodiscard]] Place anywhere();
  [[nodiscard]] bool is_free(const Place& place, std::size_t but) const;
  [[nodiscard]] bool is_free(const Way& way, std::size_t arm) const;
  bool stand_at_random(std::size_t count);
  [[nodiscard]] std::optional<Place> somewhere_free(std::size_t arm);
  // Returns the straight path if it is free, else a path over one or two random places; nullopt if
  // none is found.
  [[nodiscard]] std::optional<Way> way(std::size_t arm, const Place& to);
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random_.index(i)]);
  }

  Random random_;
  double half_m_ = 0.8;        // half the side of the square that holds all places
  std::vector<Place> stands_;  // by arm
};

}  // namespace armloom
