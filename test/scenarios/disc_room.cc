#include "test/scenarios/disc_room.h"

#include <algorithm>

namespace armloom {

double distance_to_leg(const Place& point, const Place& from, const Place& to) {
  const Place along = to - from;
  const double squared = along.squaredNorm();
  const double share =
      squared == 0.0 ? 0.0 : std::clamp((point - from).dot(along) / squared, 0.0, 1.0);
  return (from + share * along - point).norm();
}

DiscMotion disc_motion(std::size_t arm, Way way, double speed_m_s) {
  DiscMotion motion{arm, std::move(way), {0.0}};
  for (std::size_t leg = 1; leg < motion.way.size(); ++leg) {
    const double length = (motion.way[leg] - motion.way[leg - 1]).norm();
    motion.times_s.push_back(motion.times_s.back() + std::max(0.4, length / speed_m_s));
  }
  return motion;
}

Place DiscRoom::anywhere() {
  return {random_.uniform(-half_m_, half_m_), random_.uniform(-half_m_, half_m_)};
}

bool DiscRoom::is_free(const Place& place, std::size_t but) const {
  for (std::size_t i = 0; i < stands_.size(); ++i) {
    if (i != but && (stands_[i] - place).norm() < kKeptOneByOne_m) return false;
  }
  return true;
}

bool DiscRoom::is_free(const Way& way, std::size_t arm) const {
  for (std::size_t leg = 1; leg < way.size(); ++leg) {
    for (std::size_t i = 0; i < stands_.size(); ++i) {
      if (i != arm && distance_to_leg(stands_[i], way[leg - 1], way[leg]) < kKeptOneByOne_m) {
        return false;
      }
    }
  }
  return true;
}

bool DiscRoom::stand_at_random(std::size_t count) {
  for (int tries = 0; stands_.size() < count; ++tries) {
    if (tries == kTries) return false;
    const Place place = anywhere();
    if (is_free(place, stands_.size())) stands_.push_back(place);
  }
  return true;
}

std::optional<Place> DiscRoom::somewhere_free(std::size_t arm) {
  for (int tries = 0; tries < kTries; ++tries) {
    const Place place = anywhere();
    if (is_free(place, arm) && (place - stands_[arm]).norm() > 0.3) return place;
  }
  return std::nullopt;
}

std::optional<Way> DiscRoom::way(std::size_t arm, const Place& to) {
  Way found{stands_[arm], to};
  for (int tries = 0; tries < kTries; ++tries) {
    if (is_free(found, arm)) return found;
    found = {stands_[arm], anywhere()};
    if (tries > kTries / 4) found.push_back(anywhere());
    found.push_back(to);
  }
  return std::nullopt;
}

}  // namespace armloom
