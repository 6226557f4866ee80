#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/collision/check/conflict_regions.h"
#include "core/collision/diagram/motion_store.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"

namespace armloom {

// Finds the conflict regions of one Coordinated question: for every candidate with every motion of
// other arms and every arm at rest. Refines the store's diagrams to resolution_of(), and close
// passes to kClosest. States that are unknown when the budget is used up are treated as not free.
//
// Motions that share an arm are not compared. They are executed in this order:
// - motions that are not to come: others, then candidates
// - motions to come (Motion::to_come): others, then candidates
// The order within each list is that of the question.
// An arm rests before, between and after its motions. These rests are the ends of the motions'
// axes, so comparing the motions covers them. But if these motions share an arm with the candidate,
// they are not compared. Then the arm is compared as an arm at rest.
//
// A pair that is too close now may move apart (motion_checker.h) unless a motion is to come.
class PairRegionSearch {
 public:
  // `store` and `question` must outlive the search. No other question may begin in the store
  // meanwhile.
  PairRegionSearch(MotionStore& store, const Question& question);

  // Returns the regions of each candidate: with other motions, with candidates named after it, with
  // arms at rest. Omits pairs that are free everywhere.
  [[nodiscard]] std::vector<PairRegions> find();
  // Returns certificates of the compared pairs, including pairs that are free everywhere. Leaves
  // out pairs of arms that are out of reach.
  [[nodiscard]] std::vector<Certificate> take_certificates() { return std::move(certificates_); }
  // Returns the smallest limits of pairs that part; +inf if no pair parts.
  [[nodiscard]] const ClearanceBound& parted() const { return parted_; }
  // Returns true if a larger effort (Question::effort) might find more free states.
  [[nodiscard]] bool exhausted() const { return exhausted_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

  // If the shorter motion takes longer than kShort, fine cells become wider in proportion, at most
  // twice as wide. The time lost by waiting at a region's edge then stays the same share of the
  // motion.
  inline static constexpr Duration kShort = std::chrono::seconds(5);
  inline static constexpr CoordinationDiagram::Resolution kResolution{
      .coarse = std::chrono::milliseconds(160),
      .fine = std::chrono::milliseconds(80),
      .passing = {.fine = std::chrono::milliseconds(25),
                  .coarse = std::chrono::milliseconds(160),
                  .slope = 0.5}};
  [[nodiscard]] static CoordinationDiagram::Resolution resolution_of(Duration shorter);
  // Cell budget of two arms, per second of both motions together.
  inline static constexpr double kCells = 500.0;
  // Largest cell budget of two arms, so that a check's cost does not grow with the square of a
  // motion's length.
  inline static constexpr std::uint64_t kCellsMax = 400'000;
  // A region without a proven conflict may be a close pass. So it is refined to this width with the
  // same budget again; if Question::effort > 1, to CellTree::kFinest.
  inline static constexpr Duration kClosest = std::chrono::milliseconds(2);

 private:
  struct Side {  // a motion, or an arm at rest
    std::variant<StepId, ArmId> who;
    const Motion* motion;  // null if at rest
    std::vector<MotionStore::Entry*> arms;
    std::optional<CertifiedSide> certified = {};  // built on first use

    [[nodiscard]] Duration now() const;
    [[nodiscard]] const CertifiedSide& certify();
    [[nodiscard]] Duration end() const { return arms.front()->duration(); }
    [[nodiscard]] bool to_come() const { return motion != nullptr && motion->to_come; }
  };
  [[nodiscard]] Side side_of(const Motion& motion);
  [[nodiscard]] Side resting(ArmId arm, const Configuration& rest);
  [[nodiscard]] std::vector<Side> standing_beside(const Motion& candidate);
  void compare(Side& a, Side& b, std::vector<PairRegions>& found);
  [[nodiscard]] OrientedDiagram outlined(const Side& a, const Side& b, OrientedDiagram layer);
  [[nodiscard]] std::vector<BlockedRegion> blocked(const Side& a, const Side& b);
  bool refine_close_passes(const std::vector<BlockedRegion>& regions, std::uint64_t budget);
  [[nodiscard]] std::uint64_t cells_for(const Side& a, const Side& b) const;
  [[nodiscard]] Duration closest() const;
  [[nodiscard]] ConflictRegion region_of(BlockedRegion blocked);

  MotionStore& store_;
  const Question& question_;
  TrackingErrors tracking_errors_;
  std::uint64_t evaluations_ = 0;
  ClearanceBound parted_;
  bool exhausted_ = false;
  std::vector<Certificate> certificates_;
  std::vector<const Motion*> in_order_;  // all motions; those of an arm in their order of execution
  // For the current two sides:
  std::vector<OrientedDiagram> layers_;  // each arm of one side with each arm of the other
  std::vector<BlockedCell> blocked_;
  // By index in blocked_: index in layers_, and the leaf of that layer.
  std::vector<std::pair<std::size_t, CoordinationDiagram::Blocked>> leaves_;
};

}  // namespace armloom
