#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/collision/diagram/cell_tree.h"
#include "core/collision/diagram/passing_edges.h"
#include "core/collision/diagram/progress_band.h"
#include "core/collision/diagram/tube_pair.h"
#include "core/coordination/conflict_region.h"

namespace armloom {

// Two motions of different arms collide or not as a function of where each is along its own path
// (O'Donnell and Lozano-Perez 1989): cells over (trajectory time of A, trajectory time of B) that
// are certified free, in conflict, or not known yet. Cells are refined only where a question needs
// it, and kept, so that the same question asked again costs next to nothing. Of one arm against
// what stands still, or against itself, the second axis has no length.
//
// A cell is free when for every pair of bodies the distance at its middle, less what each body may
// move during the cell (MotionTube), is at least the pair's limit: then so is the distance in every
// state of the cell. Capsules answer first; where they leave it open, the exact distance of the two
// bodies at the middle does. What it leaves open for what the bodies may move, whichever way, may
// still be free for what they may move towards each other (body_sweep.h).
//
// Not thread-safe; a tube may be shared by several diagrams of one thread.
class CoordinationDiagram {
 public:
  explicit CoordinationDiagram(TubePair pair);
  [[nodiscard]] TubePair& pair() { return pair_; }
  // Memory that it holds, but for its tubes.
  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(tree_.size()) * sizeof(Node) +
           found_.size() * sizeof(NarrowWitness);
  }

  // Two bodies too close to each other.
  struct Witness {
    PairId pair;
    double distance_m;  // exact if it is below the limit; else (undecided) what is known
    Duration time_a;    // trajectory times
    Duration time_b;
    double at_s;  // when the question's band first holds it, from its beginning
  };
  struct Answer {
    bool free = false;
    bool exhausted = false;  // the budget ended before the question was decided
    // Not free: the first state in time that is proven to be a conflict, to within kFirst; or,
    // where none is proven, the first cell that could not be decided.
    std::optional<Witness> conflict;
    bool proven = false;
    std::uint64_t evaluations = 0;  // cells and states that were looked at for this question
  };
  // Looks at no more than `budget` cells and states; so do the others, which return how many.
  [[nodiscard]] Answer ask(const ProgressBand& band, std::uint64_t budget);

  // Refines the rectangle of what remains of both motions until each cell is free, in conflict, or
  // no wider than `resolution`.
  std::uint64_t refine(Duration now_a, Duration now_b, Duration resolution, std::uint64_t budget);

  // Finds where what is free of the rectangle of what remains of both motions ends: what is not
  // borders on it, or on where both stand now, in cells no wider than `fine`, or `coarse` where
  // their middle is proven to be a conflict, and where motions pass it as fine as `passing` says.
  // What lies behind them is not looked at: no motion gets there.
  struct Resolution {
    Duration coarse;
    Duration fine;
    PassingResolution passing;
  };
  //
  // Of long motions the first cells are as much wider as it takes for few of them to cover all, so
  // that the budget goes to where motions are near each other. A diagram that is full (kFull) is
  // refined no further, but begun anew when less than half of it remains.
  std::uint64_t refine_outline(Duration now_a, Duration now_b, const Resolution& resolution,
                               std::uint64_t budget);

  // The leaves that meet the rectangle of what remains and are not known to be free, in a fixed
  // order.
  struct Blocked {
    ProgressBox box;
    std::optional<Witness> found;  // at the middle, exactly; at_s is not set
    bool proven = false;           // that is closer than its limit
  };
  [[nodiscard]] std::vector<Blocked> blocked(Duration now_a, Duration now_b) const;

  // Motions that pass each other closely leave places that are neither free nor in conflict at a
  // resolution. Halves those whose middle lies in one of the areas, until each is free or no wider
  // than `finest`, or one is proven to be a conflict: then it is no close pass.
  std::uint64_t refine_close_passes(const std::vector<ProgressBox>& areas, Duration finest,
                                    std::uint64_t budget);

  using CellState = CellTree::CellState;
  struct CellView {
    ProgressBox box;
    CellState state;
  };
  // The leaves, in a fixed order; unknown ones are those that no question needed.
  [[nodiscard]] std::vector<CellView> cells() const;

  // First cells are no more than this share of the budget.
  inline static constexpr double kFirstShare = 0.125;
  inline static constexpr int kFull = 1'000'000;

  // How far the time of a first conflict may be off.
  inline static constexpr double kFirst_s = 0.01;

 private:
  using Node = CellTree::Node;
  struct NarrowWitness {  // at the middle of a cell
    PairId pair;
    int narrow;
    bool box;
    double distance_m;
  };
  struct Open {  // a cell that a question needs
    int cell;
    TimeRange times;
  };
  struct Search;

  // Questions (coordination_diagram.cc).
  [[nodiscard]] Witness witness_at(const Node& cell, PairId pair, double distance_m) const;
  [[nodiscard]] std::optional<TimeRange> meets(const ProgressBand& band, const Node& cell) const;
  void collect(int cell, Search& search);
  [[nodiscard]] const NarrowWitness* proven(const Node& cell) const;
  void consider_conflict(const Open& open, Search& search);
  [[nodiscard]] std::optional<Witness> on_the_line(const Open& open, const ProgressBand& band);

  // Refinement (diagram_refinement.cc).
  template <class Expand, class Follow>
  std::uint64_t refine_from(std::vector<int> leaves, std::uint64_t budget, const Expand& expand,
                            const Follow& follow);
  std::uint64_t refine_passing_edges(Duration now_a, Duration now_b,
                                     const PassingResolution& resolution, std::uint64_t budget);
  [[nodiscard]] double area_s2(Duration now_a, Duration now_b) const;
  [[nodiscard]] Duration first_width(Duration now_a, Duration now_b, std::uint64_t budget) const;
  void begin_anew_if_passed(Duration now_a, Duration now_b);
  void split_passing_edge(const CoarseLeaf& leaf, std::vector<int>& unknown);
  [[nodiscard]] bool is_open(const Node& cell, Duration now_a, Duration now_b) const;
  [[nodiscard]] OpenLeaf open_leaf(int cell) const;
  [[nodiscard]] bool is_outlined(Duration now_a, Duration now_b,
                                 const Resolution& resolution) const;

  // A batch of cells (diagram_cells.cc).
  void evaluate(std::span<const int> cells);
  void decide(int cell, std::vector<TubePair::Undecided>& undecided);
  [[nodiscard]] TubePair::Nodes nodes_of(const Node& cell) const;
  void note(Node& cell, const NarrowWitness& found);
  void choose_split(Node& cell, const TubePair::Undecided& worst);
  [[nodiscard]] bool clears(Node& cell, TubePair::Undecided& undecided);

  TubePair pair_;
  CellTree tree_;  // axes: times of the tubes; of an arm and itself the second one has no length
  std::vector<NarrowWitness> found_;
  struct Outlined {
    Duration now_a, now_b;
    Resolution resolution;
  };
  std::optional<Outlined> outlined_;  // as refine_outline() has completed it
  double begun_with_s2_ = 0.0;        // what remained when the first outline was asked for
};

}  // namespace armloom
