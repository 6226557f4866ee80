#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/base/ids.h"

namespace armloom {

// A rest position of an arm. While a place exists, Places returns the same pointer for an equal
// position, so places are compared by pointer. Answers about a place are stored by its id, which
// does not depend on the lifetime of the object. So a dry run that keeps places alive affects no
// other caller.
struct Place {
  std::uint64_t id;  // hash of arm and rounded q; collisions have probability 2^-64
  ArmId arm;
  Eigen::VectorXd q;  // of the arm's joints, in its order (rad, m)
};
using PlacePtr = std::shared_ptr<const Place>;

// Creates and shares places. Two positions that differ only by rounding give the same place in most
// cases.
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
