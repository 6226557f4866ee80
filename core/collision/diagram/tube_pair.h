#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/collision/diagram/motion_tube.h"
#include "core/collision/state/body_distance.h"

namespace armloom {

// The tubes of two motions and the pairs of bodies to check: of two arms, of an arm and static
// bodies, or of an arm with itself (both tubes are the same). Not thread-safe.
class TubePair {
 public:
  // Working memory for the current batch or state. TubePairs of one thread may share it.
  struct Scratch;
  [[nodiscard]] static std::shared_ptr<Scratch> make_scratch();
  // Scene and pairs must outlive the TubePair.
  struct Setting {
    const PlanningScene::Bodies* bodies;
    const PairSet* pairs;
    std::shared_ptr<Scratch> scratch;
  };
  TubePair(Setting setting, std::shared_ptr<MotionTube> a, std::shared_ptr<MotionTube> b);
  // Returns the same motions in another setting.
  [[nodiscard]] TubePair with(Setting setting) const { return {std::move(setting), a_, b_}; }

  [[nodiscard]] const std::shared_ptr<MotionTube>& a() const { return a_; }
  [[nodiscard]] const std::shared_ptr<MotionTube>& b() const { return b_; }
  [[nodiscard]] bool is_self() const { return a_ == b_; }
  // Adds evaluated cells to the progress of the current check. Returns false if the check must end
  // early.
  [[nodiscard]] bool goes_on(std::uint64_t cells) const;

  // A node of each tube: one cell. For an arm with itself, both are the same node.
  struct Nodes {
    int a;
    int b;
  };
  // A pair of capsules that the filter leaves undecided in a cell.
  struct Undecided {
    int narrow;  // index in PairSet::narrow, or of a capsule of a static box if `box`
    bool box;
    double distance_m;  // lower bound of the distance at the middle
    double moves_a_m;   // bound of the motion of a within the cell
    double moves_b_m;
    double limit_m;
    double slack_m;      // the exact distance may be this much larger
    double short_m;      // distance that the capsules lack for a proof
    double towards_a_m;  // distance by which a comes closer along the separating direction
    double towards_b_m;

    [[nodiscard]] double moves_m() const { return moves_a_m + moves_b_m; }
    // Returns the distance that the bodies lack for a proof, even if they are slack_m farther apart
    // than their capsules.
    [[nodiscard]] double needs_m() const { return short_m - slack_m; }
  };
  // Distance that may be gained by the separating direction of the exact shapes, compared with that
  // of the capsules.
  inline static constexpr double kAlongShapes_m = 0.004;

  // Places the nodes of many cells at once, which is faster than eight at a time.
  void place_all(std::span<const Nodes> nodes);
  // Places and filters up to eight cells. Until the next call, undecided(i) then returns the pairs
  // that are undecided in cell i of the batch. `in_stretches`: bounds motion in stretches of wide
  // nodes (MotionTube::kStretch), which is tighter but slower than in the whole node.
  void filter(std::span<const Nodes> batch, bool in_stretches = true);
  [[nodiscard]] std::vector<Undecided>& undecided(std::size_t of_batch);
  [[nodiscard]] NarrowPair narrow(int entry, bool box) const;

  // Returns min(exact distance at the middle of both nodes, limit_m).
  [[nodiscard]] double distance(const NarrowPair& pair, Nodes at, double limit_m,
                                const Roughness& of_surfaces = {}) const;
  // Returns how many of `limits_m` the exact distance at the middle of both nodes reaches.
  // Precondition: limits_m is ascending.
  [[nodiscard]] std::size_t limits_kept(const NarrowPair& pair, Nodes at,
                                        std::span<const double> limits_m) const;
  // Returns true if the pair is proven to keep limit_m throughout the cell. `enough_m`: see
  // keep_apart() in body_sweep.h.
  [[nodiscard]] bool keeps_apart(const NarrowPair& pair, Nodes at, double limit_m, double enough_m);
  // Returns the largest distance that keeps_apart() proves. `distance_m`: in the middle of the
  // cell.
  [[nodiscard]] double proven_distance(const NarrowPair& pair, Nodes at, double distance_m,
                                       double moves_m);

  struct PairDistance {
    PairId pair;
    double distance_m;
  };
  // Places both motions at these times. Afterwards, placed_distance() returns min(exact distance,
  // limit_m).
  void place(Duration time_a, Duration time_b);
  [[nodiscard]] double placed_distance(const NarrowPair& pair, double limit_m) const;
  // Return all pairs that are closer than their limits at these times, or the closest pair.
  [[nodiscard]] std::vector<PairDistance> too_close_at(Duration time_a, Duration time_b);
  // Returns all pairs that may be closer than their limits at these times, as the joints deviate by
  // up to the tracking errors. `distance_m` is what let_part() may require: the pair's limit or its
  // present distance, whichever is smaller, less the largest deviation now and kPartingLoss_m.
  [[nodiscard]] std::vector<PairDistance> near_at(Duration time_a, Duration time_b);
  [[nodiscard]] PairDistance closest_at(Duration time_a, Duration time_b);

 private:
  struct Gathered;
  struct Batch;
  struct Lanes;
  void look_along(Lanes& lanes, const filter::Hit& hit, unsigned lane,
                  filter::Parted& parted) const;
  [[nodiscard]] unsigned near_lanes() const;
  [[nodiscard]] int left_open(int hits);
  [[nodiscard]] double slack_m(const NarrowPair& pair) const;
  [[nodiscard]] PlacedBody placed_a(const NarrowPair& pair, Nodes at) const;
  [[nodiscard]] PlacedBody placed_b(const NarrowPair& pair, Nodes at) const;
  [[nodiscard]] const KinematicBody& body_a(const NarrowPair& pair) const;
  [[nodiscard]] const KinematicBody& body_b(const NarrowPair& pair) const;

  Setting setting_;
  std::shared_ptr<MotionTube> a_;
  std::shared_ptr<MotionTube> b_;
};

// A pair that parts may come closer by this much, because bounds are not exact. More would add up
// over several motions.
inline constexpr double kPartingLoss_m = 1e-4;
// A pair that parts keeps at least this share of its distance. For the monitor's look-ahead
// (ReachCheck), this is the only bound.
inline constexpr double kPartingShare = 0.8;
// Lets pairs move apart that are too close: each of them must keep its distance in `near` instead
// of its limit.
void let_part(PairSet& pairs, std::span<const TubePair::PairDistance> near);

}  // namespace armloom
