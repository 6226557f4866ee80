#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/collision/motion_tube.h"
#include "core/collision/region.h"

namespace armloom {

// Two motions of different arms collide or not as a function of where each is along its own path
// (O'Donnell and Lozano-Perez 1989): cells over (trajectory time of A, trajectory time of B) that
// are certified free, in conflict, or not known yet. Cells are refined only where a question needs
// it, and kept, so that the same question asked again costs next to nothing. A diagram of one arm
// against what stands still, or against itself, has the one axis only.
//
// A cell is free when for every pair of parts the distance at its middle, less what each part may
// move during the cell (MotionTube), is at least the pair's limit: then so is the distance in every
// state of the cell. Capsules answer first; where they leave it open, the exact distance of the two
// parts at the middle does. What it leaves open for what the parts may move, whichever way, may
// still be free for what they may move towards each other (part_sweep.h).
//
// Not thread-safe; a tube may be shared by several diagrams of one thread.
class CoordinationDiagram {
 public:
  // Of the cell at hand: one may serve all diagrams of a thread.
  struct Scratch;
  [[nodiscard]] static std::shared_ptr<Scratch> make_scratch();
  // Scene and pairs must outlive the diagram (they are held by its owner).
  struct Setting {
    const PlanningScene::Bodies* bodies;
    const PairSet* pairs;
    std::shared_ptr<Scratch> scratch;
  };
  // Of two arms.
  CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a,
                      std::shared_ptr<MotionTube> b);
  // Of an arm and what stands still.
  CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a, const StillParts& still);
  // Of an arm and itself; the pairs are those of its geometry.
  CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a);

  // The same motions, nothing known yet, in another setting.
  [[nodiscard]] CoordinationDiagram with(Setting setting) const;

  // Two parts too close to each other.
  struct Finding {
    PairId pair;
    double distance_m;  // exact if it is below the limit; else (undecided) what is known
    Duration time_a;    // trajectory times
    Duration time_b;
    double at_s;  // when the question's region first holds it, from its beginning
  };
  struct Answer {
    bool free = false;
    bool exhausted = false;  // the budget ended before the question was decided
    // Not free: the first state in time that is proven to be a conflict, to within kFirst; or,
    // where none is proven, the first cell that could not be decided.
    std::optional<Finding> conflict;
    bool proven = false;
    std::uint64_t evaluations = 0;  // cells and states that were looked at for this question
  };
  // Looks at no more than `budget` cells and states.
  [[nodiscard]] Answer ask(const Region& region, std::uint64_t budget);

  // Refines all that the region holds until each cell is free, in conflict, or no wider than
  // `resolution`, at the cost of about `budget` cells at most; returns how many.
  std::uint64_t refine(const Region& region, Duration resolution, std::uint64_t budget);

  // Finds where what is free of the rectangle of what remains of both motions ends: what is not
  // borders on it, or on where both stand now, in cells no wider than `fine`, or `coarse` where
  // their middle is proven to be a conflict. What lies behind them is not looked at: no motion gets
  // there. At the cost of about `budget` cells at most; returns how many.
  struct Resolution {
    Duration coarse;
    Duration fine;
  };
  std::uint64_t refine_outline(Duration now_a, Duration now_b, const Resolution& resolution,
                               std::uint64_t budget);

  // The leaves that meet the rectangle of what remains and are not known to be free, in a fixed
  // order.
  struct Blocked {
    Duration from_a, to_a, from_b, to_b;
    std::optional<Finding> found;  // at the middle, exactly; at_s is not set
    bool proven = false;           // that is closer than its limit
  };
  [[nodiscard]] std::vector<Blocked> blocked(Duration now_a, Duration now_b) const;

  // Motions that pass each other closely leave places that are neither free nor in conflict at a
  // resolution. Halves those whose middle lies in one of the areas, until each is free or no wider
  // than `finest`, or one is proven to be a conflict: then it is no close pass. At the cost of
  // about `budget` cells at most; returns how many.
  struct Area {
    Duration from_a, to_a, from_b, to_b;
  };
  std::uint64_t look_closer(const std::vector<Area>& areas, Duration finest, std::uint64_t budget);

  // Every pair that is closer than its limit where A and B are at these times, exactly.
  struct Close {
    PairId pair;
    double distance_m;
  };
  [[nodiscard]] std::vector<Close> too_close_at(Duration time_a, Duration time_b);

  // The closest pair there, exactly.
  [[nodiscard]] Close closest_at(Duration time_a, Duration time_b);

  enum class CellState : std::uint8_t { unknown, free, mixed, conflict, finest, inner };
  struct CellView {
    Duration from_a, to_a, from_b, to_b;
    CellState state;
  };
  // The leaves, in a fixed order; unknown ones are those that no question needed.
  [[nodiscard]] std::vector<CellView> cells() const;

  [[nodiscard]] MotionTube& tube_a() const { return *a_; }
  [[nodiscard]] MotionTube* tube_b() const { return b_.get(); }

  // How far the time of a first conflict may be off.
  inline static constexpr double kFirst_s = 0.01;
  // Cells are not split below this width.
  inline static constexpr Duration kFinest = std::chrono::microseconds(500);

 private:
  struct Cell {
    int a;
    int b;
    int children = -1;  // first of two or four
    CellState state = CellState::unknown;
    bool split_a = false;  // how to split: for the children of inner cells, and for mixed ones
    bool split_b = false;
    std::uint8_t levels = 1;  // of a mixed cell: how many halvings at once
    int finding = -1;         // at its middle

    [[nodiscard]] int child_count() const { return (split_a ? 2 : 1) * (split_b ? 2 : 1); }
  };
  struct Found {  // at the middle of a cell
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
  struct Undecided;

  [[nodiscard]] Cell& at(int cell) { return cells_[static_cast<std::size_t>(cell)]; }
  [[nodiscard]] std::optional<TimeRange> meets(const Region& region, const Cell& cell) const;
  void collect(int cell, Search& search);
  void split(int cell, int levels);
  [[nodiscard]] bool can_split(const Cell& cell) const;
  void split_if_wide(int cell);
  void split_if_coarse(int cell, Duration resolution);
  [[nodiscard]] bool wider(const Cell& cell, Duration resolution) const;
  [[nodiscard]] const Found* proven(const Cell& cell) const;
  std::uint64_t evaluate_all(const std::vector<Open>& open, std::uint64_t budget);
  void evaluate(const Open* open, std::size_t count);
  [[nodiscard]] bool remains(const Cell& cell, Duration now_a, Duration now_b) const;
  template <class Visit>
  bool leaves_at(const Cell& of, const Visit& visit) const;
  [[nodiscard]] bool borders_on_free(const Cell& cell) const;
  struct Gathered;
  struct Places;
  [[nodiscard]] Places places_of(const MotionTube& tube, int Cell::*node, const Open* open,
                                 std::size_t count) const;
  [[nodiscard]] static filter::Side gather(const Places& places, Gathered& to);
  [[nodiscard]] static filter::Joints gather_joints(const Places& places,
                                                    const filter::Linkage& linkage, Gathered& to);
  [[nodiscard]] int left_open(const filter::Side& a, const filter::Side& b, const Open* open,
                              std::size_t count, int hits);
  void decide(int cell);
  void note(Cell& cell, const Found& found);
  void choose_split(Cell& cell, const Undecided& worst);
  bool clears(Cell& cell, Undecided& undecided);
  [[nodiscard]] bool keeps_apart(const Cell& cell, const NarrowPair& pair, double limit_m,
                                 double enough_m);
  [[nodiscard]] const LinkagePart& second_part(const NarrowPair& pair) const;
  [[nodiscard]] const NarrowPair& narrow(int entry, bool box) const;
  [[nodiscard]] double exact(const NarrowPair& pair, const double* frames_a, const double* frames_b,
                             int stride, double limit_m) const;
  void consider_conflict(const Open& open, Search& search);
  void place_point(Duration time_a, Duration time_b);
  [[nodiscard]] std::optional<Finding> on_the_line(const Open& open, const Region& region);

  Setting setting_;
  std::shared_ptr<MotionTube> a_;
  std::shared_ptr<MotionTube> b_;  // null: still or self
  const StillParts* still_ = nullptr;
  std::vector<Cell> cells_;
  std::vector<Found> found_;
  struct Outlined {
    Duration now_a, now_b;
    Resolution resolution;
  };
  std::optional<Outlined> outlined_;  // as refine_outline() has completed it
};

}  // namespace armloom
