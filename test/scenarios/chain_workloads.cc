#include "test/scenarios/chain_workloads.h"

#include <stdexcept>

#include "test/scenarios/disc_room.h"

namespace armloom {
namespace {

class Chain final : private DiscRoom {
 public:
  explicit Chain(std::uint64_t seed) : DiscRoom(seed) {}

  std::optional<CrowdedWorkload> make(std::size_t arms, std::size_t jobs, bool after) {
    half_m_ = random_.uniform(0.3, 0.45) + 0.06 * static_cast<double>(arms);
    if (!stand_at_random(arms)) return std::nullopt;
    made_.homes = stands_;
    while (made_.submitted.size() < jobs) {
      if (!go(random_.index(arms))) return std::nullopt;
      if (after && random_.chance(0.3)) come_after();
    }
    return std::move(made_);
  }

 private:
  // Tries up to 20 random goals, because some have no path that is found quickly.
  bool go(std::size_t arm) {
    for (int tries = 0; tries < 20; ++tries) {
      const auto to = somewhere_free(arm);
      const auto free = to ? way(arm, *to) : std::nullopt;
      if (!free) continue;
      made_.submitted.push_back({0.0, disc_motion(arm, *free, random_.uniform(0.25, 0.7)), {}});
      made_.solution.push_back({made_.submitted.back().motion});
      stands_[arm] = *to;
      return true;
    }
    return false;
  }
  void come_after() {
    const std::size_t before = made_.submitted.size() - 1;
    for (std::size_t n = 0; n < 1 + random_.index(2) && before > 0; ++n) {
      made_.submitted.back().after.push_back(random_.index(before));
    }
  }

  CrowdedWorkload made_{.crowd = Crowd::queues};
};

}  // namespace

CrowdedWorkload make_chain(std::size_t arms, std::size_t jobs, bool after, std::uint64_t seed) {
  for (std::uint64_t attempt = 0; attempt < 200; ++attempt) {
    auto made = Chain(seed + (attempt << 32U)).make(arms, jobs, after);
    if (!made) continue;
    made->seed = seed;
    return std::move(*made);
  }
  throw std::runtime_error("no chain for seed " + std::to_string(seed));
}

}  // namespace armloom
