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

// The coordination diagram of two motions of different arms (O'Donnell and Lozano-Perez 1989). A
// state is (trajectory time of A, trajectory time of B). Each cell of states is certified free, in
// conflict, or not known yet. Cells are refined only where a question needs it. They are kept, so
// repeating a question costs next to nothing. If one arm is compared with static bodies or with
// itself, the second axis has zero length.
//
// A cell is free if every pair of bodies keeps its limit in all states of the cell. This is proven
// if the distance at the cell's middle, less the motion of both bodies within the cell
// (MotionTube), is at least the limit. The distance of the capsules is tried first, then the exact
// distance. The last attempt takes only motion of the bodies towards each other into account
// (body_sweep.h).
//
// Not thread-safe; diagrams of one thread may share tubes.
class CoordinationDiagram {
 public:
  explicit CoordinationDiagram(TubePair pair);
  [[nodiscard]] TubePair& pair() { return pair_; }
  // Returns the memory used, without the tubes.
  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(tree_.size()) * sizeof(Node) +
           found_.size() * sizeof(NarrowWitness);
  }

  struct Witness {
    PairId pair;
    double distance_m;  // exact if below the limit, else a lower bound
    Duration time_a;    // trajectory times
    Duration time_b;
    double at_s;  // time until the question's band (ProgressBand) first contains this state
  };
  struct Answer {
    bool free = false;
    bool exhausted = false;  // the budget ended before the question was decided
    // If proven, the first conflict in time, to within kFirst_s. Else, the closest pair at the
    // middle of the first cell that could not be decided. nullopt if free.
    std::optional<Witness> conflict;
    bool proven = false;
    std::uint64_t evaluations = 0;  // number of cells and states
  };
  // ask() evaluates at most `budget` cells and states. The refine functions stop within a batch of
  // eight cells after `budget`. They return the number of evaluated cells, or at least `budget` if
  // the check was interrupted.
  [[nodiscard]] Answer ask(const ProgressBand& band, std::uint64_t budget);

  // Refines the cells that remain from (now_a, now_b) on. Afterwards each is free, in conflict, or
  // no wider than `resolution`.
  std::uint64_t refine(Duration now_a, Duration now_b, Duration resolution, std::uint64_t budget);

  // Refines the border of the free part of the diagram, from (now_a, now_b) on. The border consists
  // of the cells that touch a free cell, or touch the edge where a motion is now. These cells
  // become no wider than `fine`, or `coarse` if their middle is in conflict. Where motions pass a
  // region, cells become as narrow as `passing` requires. Cells behind the border are not
  // evaluated, because no motion gets there.
  struct Resolution {
    Duration coarse;
    Duration fine;
    PassingResolution passing;
  };
  // For long motions, refine_outline() begins with wider cells, so that the budget is spent where
  // motions are close. A full diagram (kFull) is not refined further. It starts again when less
  // than half of its area remains.
  std::uint64_t refine_outline(Duration now_a, Duration now_b, const Resolution& resolution,
                               std::uint64_t budget);

  // Returns the leaves from (now_a, now_b) on that are not known to be free, in a fixed order.
  struct Blocked {
    ProgressBox box;
    std::optional<Witness> found;  // closest pair found at the middle; at_s is not set
    bool proven = false;           // `found` is closer than its limit
  };
  [[nodiscard]] std::vector<Blocked> blocked(Duration now_a, Duration now_b) const;

  // Cells that are neither free nor in conflict remain if motions pass each other closely. Halves
  // such cells if their middle lies in one of `areas`, until each is free or no wider than
  // `finest`. Stops at a proven conflict, because then the motions do not just pass closely.
  std::uint64_t refine_close_passes(const std::vector<ProgressBox>& areas, Duration finest,
                                    std::uint64_t budget);

  using CellState = CellTree::CellState;
  struct CellView {
    ProgressBox box;
    CellState state;
  };
  // Returns the leaves, in a fixed order. A leaf is unknown if no question needed it.
  [[nodiscard]] std::vector<CellView> cells() const;

  // Largest share of the budget that refine_outline() spends on its first, wide cells.
  inline static constexpr double kFirstShare = 0.125;
  inline static constexpr int kFull = 1'000'000;  // number of cells

  inline static constexpr double kFirst_s = 0.01;

 private:
  using Node = CellTree::Node;
  struct NarrowWitness {  // a pair and its distance at the middle of a cell
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
  void evaluate(std::span<const int> cells, bool in_stretches = true);
  void decide(int cell, std::vector<TubePair::Undecided>& undecided);
  [[nodiscard]] TubePair::Nodes nodes_of(const Node& cell) const;
  void note(Node& cell, const NarrowWitness& found);
  void choose_split(Node& cell, const TubePair::Undecided& worst);
  [[nodiscard]] bool clears(Node& cell, TubePair::Undecided& undecided);

  TubePair pair_;
  CellTree tree_;  // axes: times of the two tubes; the second has zero length for one arm alone
  std::vector<NarrowWitness> found_;
  struct Outlined {
    Duration now_a, now_b;
    Resolution resolution;
  };
  std::optional<Outlined> outlined_;  // last completed refine_outline()
  double begun_with_s2_ = 0.0;        // area (s^2) that remained at the first refine_outline()
};

}  // namespace armloom
