#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/base/ids.h"

namespace armloom {

// Where an arm rests. While one is held, whoever else asks for the same place is given that one:
// compare pointers. What is known of a place is kept by its id, which is the same whenever somebody
// asks for it: who holds one for how long, as a dry run does, changes nothing for others.
struct Place {
  std::uint64_t id;  // of arm and rounded q; two places share one with a probability of 2^-64
  ArmId arm;
  Eigen::VectorXd q;  // of the arm's joints, in its order (rad, m)
};
using PlacePtr = std::shared_ptr<const Place>;

// Gives places. Two that differ by no more than rounding are one, mostly.
class Places {
 public:
  inline static constexpr double kRounding = 1e-6;  // rad, m

  [[nodiscard]] PlacePtr of(ArmId arm, const Eigen::VectorXd& q);

 private:
  using Key = std::vector<std::int64_t>;
  void drop_unused();

  std::map<Key, std::weak_ptr<const Place>> known_;
  std::size_t dropped_at_ = 64;  // when there are so many
};

}  // namespace armloom
