#pragma once

#include <span>
#include <vector>

#include "core/collision/filter/kernels.h"
#include "core/collision/filter/pair_set.h"
#include "core/collision/state/body_distance.h"

namespace armloom {

// So many states are looked at in one go.
inline constexpr auto kStatesAtOnce = static_cast<std::size_t>(filter::kLanes);

// Up to eight configurations of a whole cell as the filter's kernels place them, and all pairs that
// the scene looks at, with limits of one's own. Not thread-safe.
class PlacedCell {
 public:
  PlacedCell(const PlanningScene::Bodies& bodies, const PairLimits& limits);

  void set_limits(const PairLimits& limits);
  [[nodiscard]] const PairLimits& limits() const { return limits_; }
  // One to eight; throws std::invalid_argument otherwise.
  void place(std::span<const Configuration* const> states);

  // The pairs of two arms, of an arm and itself (b == a), or of an arm and what stands still.
  struct Comparison {
    std::size_t a;
    std::size_t b;
    PairSet pairs;
  };
  [[nodiscard]] const std::vector<Comparison>& comparisons() const { return comparisons_; }
  // Calls visit(hits, what stands behind them) for what the filter leaves open in these lanes.
  template <class Visit>
  void filter(const Comparison& c, unsigned lanes, const Visit& visit) {
    const filter::Kernel& kernel = filter::best_kernel();
    const PairSet& set = c.pairs;
    const auto found = [&](int count) {
      return std::span<const filter::Hit>(hits_).first(static_cast<std::size_t>(count));
    };
    visit(found(kernel.near_pairs(arms_[c.a].side(), arms_[c.b].side(), set.grouped(), lanes,
                                  hits_.data())),
          set.narrow);
    if (set.boxes.empty()) return;
    visit(found(kernel.near_boxes(arms_[c.a].side(), set.boxes.data(),
                                  static_cast<int>(set.boxes.size()), lanes, hits_.data())),
          set.narrow_boxes);
  }
  // Parts of a side (Comparison::a, b) where they are placed.
  [[nodiscard]] PlacedBody body(std::size_t side, int index, std::size_t lane) const;

 private:
  struct Side {  // an arm with room for eight placements, or what stands still
    Side(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm);
    void place();
    [[nodiscard]] filter::Side side() const { return {capsules.data(), nullptr, ball.data()}; }

    ArmKinematics kinematics;
    std::vector<double> q, frames;
    std::vector<float> axes, capsules, ball;
  };
  void compare(std::size_t a, std::size_t b);

  const PlanningScene::Bodies& bodies_;
  PairLimits limits_;
  std::vector<Side> arms_;  // the last one is what stands still
  std::vector<Comparison> comparisons_;
  std::vector<filter::Hit> hits_;
};

}  // namespace armloom
