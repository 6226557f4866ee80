#include "core/sequence/places.h"

#include <cmath>

namespace armloom {
PlacePtr Places::of(ArmId arm, const Eigen::VectorXd& q) {
  Key key{arm.value()};
  for (const double value : q) key.push_back(std::llround(value / kRounding));
  std::weak_ptr<const Place>& known = known_[std::move(key)];
  if (auto place = known.lock()) return place;
  auto place = std::make_shared<const Place>(Place{++last_, arm, q});
  known = place;
  if (known_.size() > dropped_at_) drop_unused();
  return place;
}

void Places::drop_unused() {
  std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
  dropped_at_ = 2 * known_.size() + 64;
}

}  // namespace armloom
