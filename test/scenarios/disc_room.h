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
// Straight legs along the way, each at this speed but no shorter than 0.4 s.
[[nodiscard]] DiscMotion disc_motion(std::size_t arm, Way way, double speed_m_s);

// A square in which discs stand, and where one of them could go while the others stand.
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
  // Straight if that is free, else over one or two random places.
  [[nodiscard]] std::optional<Way> way(std::size_t arm, const Place& to);
  template <class T>
  void shuffle(std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random_.index(i)]);
  }

  Random random_;
  double half_m_ = 0.8;        // of the square in which all places are
  std::vector<Place> stands_;  // by arm
};

}  // namespace armloom
