#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/collision/diagram/motion_tube.h"
#include "core/collision/state/body_distance.h"

namespace armloom {

// The tubes of two motions and the pairs of bodies that are held apart: of two arms, of an arm and
// what stands still, or of an arm and itself (both tubes are one). Not thread-safe.
class TubePair {
 public:
  // Of the batch or state at hand: one may serve all pairs of a thread.
  struct Scratch;
  [[nodiscard]] static std::shared_ptr<Scratch> make_scratch();
  // Scene and pairs must outlive the pair (they are held by its owner).
  struct Setting {
    const PlanningScene::Bodies* bodies;
    const PairSet* pairs;
    std::shared_ptr<Scratch> scratch;
  };
  TubePair(Setting setting, std::shared_ptr<MotionTube> a, std::shared_ptr<MotionTube> b);
  // The same motions in another setting.
  [[nodiscard]] TubePair with(Setting setting) const { return {std::move(setting), a_, b_}; }

  [[nodiscard]] const std::shared_ptr<MotionTube>& a() const { return a_; }
  [[nodiscard]] const std::shared_ptr<MotionTube>& b() const { return b_; }
  [[nodiscard]] bool is_self() const { return a_ == b_; }
  // Counts cells of the check at hand; returns false if it is to end early.
  [[nodiscard]] bool goes_on(std::uint64_t cells) const;

  // One node of each; of an arm and itself twice the same.
  struct Nodes {
    int a;
    int b;
  };
  // A pair of capsules that the filter leaves open while both are within their nodes.
  struct Undecided {
    int narrow;  // in PairSet::narrow, or narrow_boxes
    bool box;
    double distance_m;  // lower bound at the middle
    double moves_a_m;   // within the node
    double moves_b_m;
    double limit_m;
    double slack_m;      // by how much the exact distance may be above the bound
    double short_m;      // how much farther apart capsules would have to be to be proven
    double towards_a_m;  // how much closer each comes during the node along what parts them
    double towards_b_m;

    [[nodiscard]] double moves_m() const { return moves_a_m + moves_b_m; }
    // How much farther the bodies would have to be: what is inside of capsules is not farther from
    // the other body than they stand off.
    [[nodiscard]] double needs_m() const { return short_m - slack_m; }
  };
  // What the exact shapes' own direction may gain over the capsules'.
  inline static constexpr double kAlongShapes_m = 0.004;

  // Places many at once, which costs less than eight by eight.
  void place_all(std::span<const Nodes> nodes);
  // Places and filters up to eight; undecided() then tells what is open of each, until the next
  // call.
  void filter(std::span<const Nodes> batch);
  [[nodiscard]] std::vector<Undecided>& undecided(std::size_t of_batch);
  // What stands behind it.
  [[nodiscard]] const NarrowPair& narrow(int entry, bool box) const;

  // min(exact distance at the middle of both nodes, limit_m).
  [[nodiscard]] double distance(const NarrowPair& pair, Nodes at, double limit_m,
                                const Roughness& of_surfaces = {}) const;
  // How many of these limits the exact distance there is not below. Precondition: ascending.
  [[nodiscard]] std::size_t limits_kept(const NarrowPair& pair, Nodes at,
                                        std::span<const double> limits_m) const;
  // Whether the pair keeps its limit all over both nodes where the bodies that come into question
  // are enough_m apart at the middle or do not come that close along their direction.
  [[nodiscard]] bool keeps_apart(const NarrowPair& pair, Nodes at, double limit_m, double enough_m);

  struct PairDistance {
    PairId pair;
    double distance_m;
  };
  // Puts both at these trajectory times, for the three below.
  void place(Duration time_a, Duration time_b);
  [[nodiscard]] double placed_distance(const NarrowPair& pair, double limit_m) const;
  // Every pair that is closer than its limit there, exactly; and the closest pair.
  [[nodiscard]] std::vector<PairDistance> too_close_at(Duration time_a, Duration time_b);
  [[nodiscard]] PairDistance closest_at(Duration time_a, Duration time_b);

 private:
  struct Gathered;
  struct Batch;
  struct Lanes;
  void look_along(Lanes& lanes, const filter::Hit& hit, unsigned lane,
                  filter::Parted& parted) const;
  [[nodiscard]] int left_open(unsigned of_batch, int hits);
  [[nodiscard]] double slack_m(const NarrowPair& pair) const;
  [[nodiscard]] PlacedBody placed_a(const NarrowPair& pair, Nodes at) const;
  [[nodiscard]] PlacedBody placed_b(const NarrowPair& pair, Nodes at) const;
  [[nodiscard]] const KinematicBody& body_a(const NarrowPair& pair) const;
  [[nodiscard]] const KinematicBody& body_b(const NarrowPair& pair) const;

  Setting setting_;
  std::shared_ptr<MotionTube> a_;
  std::shared_ptr<MotionTube> b_;
};

}  // namespace armloom
