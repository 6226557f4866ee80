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

// The regions of one Coordinated question: every candidate against every motion of other arms and
// every arm that no motion moves. Diagrams are those of the store, and are refined no further than
// resolution_of() (but see kClosest); what is not known when kCells are used up counts as not free.
//
// Motions that share an arm follow each other and are not compared: those that are not to come,
// then others, then candidates, as named. Where an arm stands before, between and after its motions
// is an end of one of their axes; but for those that share an arm with the candidate: there it
// counts as an arm at rest.
//
// A pair that is too close where both stand now may part (motion_checker.h); there, neither is to
// come.
class PairRegionSearch {
 public:
  // `store` and `question` outlive it; no question is begun in the store meanwhile.
  PairRegionSearch(MotionStore& store, const Question& question);

  // By candidate; for each, others, candidates named behind it, arms at rest. Pairs that are free
  // everywhere are left out.
  [[nodiscard]] std::vector<PairRegions> find();
  // Of all pairs that can reach each other, also those that are free everywhere.
  [[nodiscard]] std::vector<Certificate> take_certificates() { return std::move(certificates_); }
  // What pairs that part were held to; +inf: there are none.
  [[nodiscard]] const ClearanceBound& parted() const { return parted_; }
  // Where no conflict is proven, a larger effort might have found more that is free.
  [[nodiscard]] bool exhausted() const { return exhausted_; }
  // Cells looked at.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

  // Where one of the motions takes no longer than kShort; where both do, fine cells are as much
  // wider as the shorter one is longer, up to twice: what an arm loses at a region is the same
  // share.
  inline static constexpr Duration kShort = std::chrono::seconds(5);
  inline static constexpr CoordinationDiagram::Resolution kResolution{
      .coarse = std::chrono::milliseconds(160),
      .fine = std::chrono::milliseconds(80),
      .passing = {.fine = std::chrono::milliseconds(25),
                  .coarse = std::chrono::milliseconds(160),
                  .slope = 0.5}};
  [[nodiscard]] static CoordinationDiagram::Resolution resolution_of(Duration shorter);
  // Of two arms, for each second of both motions together.
  inline static constexpr double kCells = 500.0;
  // More than this no pair of arms gets, whatever the effort: the cost of a check does not grow
  // with the square of a motion's length. What is not decided by then counts as not free.
  inline static constexpr std::uint64_t kCellsMax = 400'000;
  // Where no conflict is proven it may be a close pass: there, down to here, at as many cells more;
  // with more than the usual effort as far as cells go.
  inline static constexpr Duration kClosest = std::chrono::milliseconds(2);

 private:
  struct Side {  // a motion, or an arm at rest
    std::variant<JobId, ArmId> who;
    const Motion* motion;  // null: at rest
    std::vector<MotionStore::Entry*> arms;
    std::optional<CertifiedSide> certified = {};  // once it was asked for

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
  double tracking_error_;
  std::uint64_t evaluations_ = 0;
  ClearanceBound parted_;
  bool exhausted_ = false;
  std::vector<Certificate> certificates_;
  std::vector<const Motion*> in_order_;  // all motions: of each arm, as they follow each other
  // Of the two sides at hand:
  std::vector<OrientedDiagram> layers_;  // one arm of one against one of the other
  std::vector<BlockedCell> blocked_;
  std::vector<std::pair<std::size_t, CoordinationDiagram::Blocked>> leaves_;  // layer, by blocked_
};

}  // namespace armloom
