#include "core/sequence/places.h"

#include <cmath>

namespace armloom {
namespace {

// Mixes each word by the finalizer of splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t id_of(const std::vector<std::int64_t>& key) {
  std::uint64_t id = 0;
  for (const std::int64_t word : key) {
    id += static_cast<std::uint64_t>(word) + 0x9e3779b97f4a7c15U;
    id = (id ^ (id >> 30U)) * 0xbf58476d1ce4e5b9U;
    id = (id ^ (id >> 27U)) * 0x94d049bb133111ebU;
    id ^= id >> 31U;
  }
  return id;
}

}  // namespace

PlacePtr Places::of(ArmId arm, const Eigen::VectorXd& q) {
  Key key{arm.value()};
  for (const double value : q) key.push_back(std::llround(value / kRounding));
  const std::uint64_t id = id_of(key);
  std::weak_ptr<const Place>& known = known_[std::move(key)];
  if (auto place = known.lock()) return place;
  auto place = std::make_shared<const Place>(Place{id, arm, q});
  known = place;
  if (known_.size() > dropped_at_) drop_unused();
  return place;
}

void Places::drop_unused() {
  std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
  dropped_at_ = 2 * known_.size() + 64;
}

}  // namespace armloom
