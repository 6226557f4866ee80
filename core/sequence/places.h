#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/base/ids.h"

namespace armloom {

// The rest position of an arm. While a place exists, equal requests return the same pointer, so
// places are compared by pointer. Knowledge about a place is stored by its id, which does not
// depend on the lifetime of the object: a dry run that holds places affects no other caller.
struct Place {
  std::uint64_t id;  // hash of arm and rounded q; collisions have probability 2^-64
  ArmId arm;
  Eigen::VectorXd q;  // of the arm's joints, in its order (rad, m)
};
using PlacePtr = std::shared_ptr<const Place>;

// Returns shared places. Two positions that differ by rounding only give, mostly, the same place.
class Places {
 public:
  inline static constexpr double kRounding = 1e-6;  // rad, m

  [[nodiscard]] PlacePtr of(ArmId arm, const Eigen::VectorXd& q);

 private:
  using Key = std::vector<std::int64_t>;
  void drop_unused();

  std::map<Key, std::weak_ptr<const Place>> known_;
  std::size_t dropped_at_ = 64;  // size at which unused entries are dropped
};

}  // namespace armloom
