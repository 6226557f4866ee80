#pragma once

#include <span>
#include <vector>

#include "core/collision/filter/kernels.h"
#include "core/collision/filter/pair_set.h"
#include "core/collision/state/body_distance.h"

namespace armloom {

// Number of states that are checked together.
inline constexpr auto kStatesAtOnce = static_cast<std::size_t>(filter::kLanes);

// Up to eight configurations of a whole cell, placed by the kernels, and all pairs to check with
// their limits. Not thread-safe.
class PlacedCell {
 public:
  PlacedCell(const PlanningScene::Bodies& bodies, const PairLimits& limits);

  void set_limits(const PairLimits& limits);
  [[nodiscard]] const PairLimits& limits() const { return limits_; }
  // Places one to eight states; throws std::invalid_argument otherwise.
  void place(std::span<const Configuration* const> states);

  // The pairs of two arms, of an arm and itself (b == a), or of an arm and the static bodies. a and
  // b are indices of sides.
  struct Comparison {
    std::size_t a;
    std::size_t b;
    PairSet pairs;
  };
  [[nodiscard]] const std::vector<Comparison>& comparisons() const { return comparisons_; }
  // Calls visit(hit, pair) for each pair that the filter leaves undecided in `lanes`.
  template <class Visit>
  void filter(const Comparison& c, unsigned lanes, const Visit& visit) {
    const filter::Kernel& kernel = filter::best_kernel();
    const PairSet& set = c.pairs;
    const auto found = [&](int count) {
      return std::span<const filter::Hit>(hits_).first(static_cast<std::size_t>(count));
    };
    const filter::Side side = arms_[c.a].side();
    for (const filter::Hit& hit :
         found(kernel.near_pairs(side, arms_[c.b].side(), set.grouped(), lanes, hits_.data()))) {
      visit(hit, set.narrow[static_cast<std::size_t>(hit.pair)]);
    }
    if (set.boxes.empty()) return;
    for (const filter::Hit& hit :
         found(kernel.near_boxes(side, set.all_boxes(), lanes, hits_.data()))) {
      visit(hit, set.narrow_of(hit.pair, hit.capsule));
    }
  }
  // Returns a body and its pose in one lane. `side`: Comparison::a or b. `index`:
  // NarrowPair::body_a or body_b.
  [[nodiscard]] PlacedBody body(std::size_t side, int index, std::size_t lane) const;

 private:
  struct Side {  // an arm with eight placements, or the static bodies
    Side(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm);
    void place();
    [[nodiscard]] filter::Side side() const {
      return {capsules.data(),
              nullptr,
              ball.data(),
              {spread.data(), static_cast<int>(spread.size() / 4)}};
    }

    ArmKinematics kinematics;
    std::vector<double> q, frames;
    std::vector<float> axes, capsules, ball, spread;
  };
  void compare(std::size_t a, std::size_t b);

  const PlanningScene::Bodies& bodies_;
  PairLimits limits_;
  std::vector<Side> arms_;  // all arms, then the static bodies
  std::vector<Comparison> comparisons_;
  std::vector<filter::Hit> hits_;
};

}  // namespace armloom
