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

// The coordination diagram of two motions of different arms (O'Donnell and Lozano-Perez 1989):
// whether they collide depends only on where each is along its own path. Cells over (trajectory
// time of A, trajectory time of B) are certified free, in conflict, or not known yet. Cells are
// refined only where a question needs it, and kept, so that repeating a question costs next to
// nothing. For one arm against static bodies, or against itself, the second axis has no length.
//
// A cell is free if every pair of bodies keeps its limit in every state of the cell. The proof
// takes the distance at the cell's middle, less the motion of each body within the cell
// (MotionTube). Capsules are tried first, then the exact distance at the middle, and last the
// motion of the bodies towards each other only (body_sweep.h).
//
// Not thread-safe; diagrams of one thread may share tubes.
class CoordinationDiagram {
 public:
  explicit CoordinationDiagram(TubePair pair);
  [[nodiscard]] TubePair& pair() { return pair_; }
  // Returns the memory in use, without the tubes.
  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(tree_.size()) * sizeof(Node) +
           found_.size() * sizeof(NarrowWitness);
  }

  // Two bodies too close to each other.
  struct Witness {
    PairId pair;
    double distance_m;  // exact if below the limit; else (undecided) a lower bound
    Duration time_a;    // trajectory times
    Duration time_b;
    double at_s;  // time from the start of the question's band until this state is first reached
  };
  struct Answer {
    bool free = false;
    bool exhausted = false;  // the budget ended before the question was decided
    // Set if not free. If proven: the first proven conflict in time, to within kFirst_s. Else: the
    // first cell that could not be decided.
    std::optional<Witness> conflict;
    bool proven = false;
    std::uint64_t evaluations = 0;  // cells and states evaluated for this question
  };
  // Evaluates no more than `budget` cells and states. The refine functions stop within one batch of
  // eight cells after `budget`, and return the number of evaluated cells (at least `budget` if
  // interrupted).
  [[nodiscard]] Answer ask(const ProgressBand& band, std::uint64_t budget);

  // Refines what remains of both motions until each cell is free, in conflict, or no wider than
  // `resolution`.
  std::uint64_t refine(Duration now_a, Duration now_b, Duration resolution, std::uint64_t budget);

  // Refines the border of the free part of what remains of both motions: cells that are not free
  // and touch a free cell, or an edge where one motion is now. These become no wider than `fine`,
  // or `coarse` if their middle is a proven conflict, and as fine as `passing` says where motions
  // pass a region. Cells behind the border are not evaluated, because no motion gets there.
  struct Resolution {
    Duration coarse;
    Duration fine;
    PassingResolution passing;
  };
  //
  // For long motions the first cells are wider, so that few of them cover everything and the budget
  // goes where the motions are close. A full diagram (kFull) is not refined further; it starts
  // again when less than half of its area remains.
  std::uint64_t refine_outline(Duration now_a, Duration now_b, const Resolution& resolution,
                               std::uint64_t budget);

  // Returns the leaves in what remains of both motions that are not known to be free, in a fixed
  // order.
  struct Blocked {
    ProgressBox box;
    std::optional<Witness> found;  // at the middle; at_s is not set
    bool proven = false;           // found->distance_m is below the pair's limit
  };
  [[nodiscard]] std::vector<Blocked> blocked(Duration now_a, Duration now_b) const;

  // Motions that pass each other closely leave cells that are neither free nor in conflict. Halves
  // such cells if their middle lies in one of `areas`, until each is free or no wider than
  // `finest`. Stops when one is a proven conflict, because then the motions do not pass.
  std::uint64_t refine_close_passes(const std::vector<ProgressBox>& areas, Duration finest,
                                    std::uint64_t budget);

  using CellState = CellTree::CellState;
  struct CellView {
    ProgressBox box;
    CellState state;
  };
  // Returns the leaves, in a fixed order. No question has needed the unknown ones so far.
  [[nodiscard]] std::vector<CellView> cells() const;

  // The first cells take no more than this share of the budget.
  inline static constexpr double kFirstShare = 0.125;
  // A diagram with this many cells is full.
  inline static constexpr int kFull = 1'000'000;

  // Tolerance of the time of a first conflict.
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
  CellTree tree_;  // axes: times of the tubes; the second has no length for an arm and itself
  std::vector<NarrowWitness> found_;
  struct Outlined {
    Duration now_a, now_b;
    Resolution resolution;
  };
  std::optional<Outlined> outlined_;  // the last refine_outline() that was completed
  double begun_with_s2_ = 0.0;        // area that remained at the first refine_outline()
};

}  // namespace armloom
