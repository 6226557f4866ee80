// One batch of cells: from the filter over the exact distance to a state.
#include <algorithm>
#include <array>

#include "core/collision/coordination_diagram_impl.h"
#include "core/collision/filter/kernels.h"
#include "core/collision/part_distance.h"
#include "core/collision/part_sweep.h"

namespace armloom {
namespace {

constexpr int kLanes = filter::kLanes;

// A side is halved together with the other if it moves at least this share as much.
constexpr double kBothShare = 0.5;

// Parts move towards each other at least this share of what they may move in all directions,
// mostly: where more than that would have to be nothing, it is not asked.
constexpr double kTowardsShare = 0.25;

}  // namespace

// Where the nodes of a batch of cells are in their tube, lane by lane.
struct CoordinationDiagram::Places {
  std::array<MotionTube::Place, kLanes> of;
  std::size_t count;

  // The block that they are, in its order; null: they are none.
  [[nodiscard]] const MotionTube::Block* as_block() const {
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (of[lane].block != of[0].block || of[lane].lane != lane) return nullptr;
    }
    return of[0].block;
  }
  // Every row of them.
  void copy(std::vector<float> MotionTube::Block::*rows, std::vector<float>& to) const {
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::vector<float>& from = of[lane].block->*rows;
      for (std::size_t row = 0; row < from.size(); row += kLanes) {
        to[row + lane] = from[row + of[lane].lane];
      }
    }
  }
};

CoordinationDiagram::Places CoordinationDiagram::places_of(const MotionTube& tube, int Cell::*node,
                                                           const Open* open,
                                                           std::size_t count) const {
  Places places{{}, count};
  for (std::size_t lane = 0; lane < count; ++lane) {
    places.of[lane] = tube.place_of(cells_[static_cast<std::size_t>(open[lane].cell)].*node);
  }
  return places;
}

// As one side: the block itself where they are one.
filter::Side CoordinationDiagram::gather(const Places& places, Gathered& to) {
  using Block = MotionTube::Block;
  if (const Block* block = places.as_block()) {
    return {block->capsules.data(), block->inflation.data(), block->ball.data()};
  }
  places.copy(&Block::capsules, to.capsules);
  places.copy(&Block::inflation, to.inflation);
  places.copy(&Block::ball, to.ball);
  return {to.capsules.data(), to.inflation.data(), to.ball.data()};
}

filter::Joints CoordinationDiagram::gather_joints(const Places& places,
                                                  const filter::Linkage& linkage, Gathered& to) {
  using Block = MotionTube::Block;
  if (const Block* block = places.as_block()) {
    return {&linkage, block->axes.data(), block->spans.data(), block->bends.data()};
  }
  places.copy(&Block::axes, to.axes);
  places.copy(&Block::spans, to.spans);
  places.copy(&Block::bends, to.bends);
  return {&linkage, to.axes.data(), to.spans.data(), to.bends.data()};
}

// Of the pairs that bounds of their motion leave open, those that stay so along the direction that
// parts them. Returns their number.
int CoordinationDiagram::left_open(const filter::Side& a, const filter::Side& b, const Open* open,
                                   std::size_t count, int hits) {
  if (hits == 0) return 0;
  Scratch& s = *setting_.scratch;
  const filter::Linkage linkage_a = a_->linkage().view();
  const filter::Joints of_a = gather_joints(places_of(*a_, &Cell::a, open, count), linkage_a, s.a);
  const filter::Linkage linkage_b = b_ ? b_->linkage().view() : filter::Linkage{};
  const filter::Joints of_b =
      b_ ? gather_joints(places_of(*b_, &Cell::b, open, count), linkage_b, s.b) : filter::Joints{};
  const filter::Kernel& kernel = filter::best_kernel();
  int left = 0;
  for (int h = 0; h < hits; ++h) {
    filter::Hit& hit = s.hits[static_cast<std::size_t>(h)];
    const filter::Pair& pair = setting_.pairs->pairs[static_cast<std::size_t>(hit.pair)];
    hit.lanes &= ~kernel.keep_apart(a, of_a, b, of_b, pair, hit.lanes);
    if (hit.lanes == 0) continue;
    if (left != h) s.hits[static_cast<std::size_t>(left)] = hit;
    ++left;
  }
  return left;
}

void CoordinationDiagram::evaluate(const Open* open, std::size_t count) {
  Scratch& s = *setting_.scratch;
  s.nodes.clear();
  for (std::size_t i = 0; i < count; ++i) s.nodes.push_back(at(open[i].cell).a);
  a_->place(s.nodes);
  if (b_) {
    s.nodes.clear();
    for (std::size_t i = 0; i < count; ++i) s.nodes.push_back(at(open[i].cell).b);
    b_->place(s.nodes);
  }
  const PairSet& set = *setting_.pairs;
  const bool self = !b_ && still_ == nullptr;
  int pairs = 0;
  int boxes = 0;
  filter::Side a{};
  if (!self) {
    a = gather(places_of(*a_, &Cell::a, open, count), s.a);
    const filter::Kernel& kernel = filter::best_kernel();
    const unsigned lanes = (1U << count) - 1U;
    const filter::Side b = b_ ? gather(places_of(*b_, &Cell::b, open, count), s.b)
                              : filter::Side{still_->lanes.data(), still_->at_rest.data(), nullptr};
    pairs = kernel.near_pairs(a, b, set.pairs.data(), static_cast<int>(set.pairs.size()),
                              set.grouped(), lanes, s.hits.data());
    pairs = left_open(a, b, open, count, pairs);
    boxes = kernel.near_boxes(a, set.boxes.data(), static_cast<int>(set.boxes.size()), lanes,
                              s.box_hits.data());
  }
  const auto excess = [&](const NarrowPair& entry) {
    const PartPair& pair = setting_.bodies->pairs[entry.pair.index()];
    return setting_.bodies->parts[pair.a].capsule_excess_m +
           setting_.bodies->parts[pair.b].capsule_excess_m;
  };
  const auto add = [&](const filter::Hit& hit, std::size_t lane, bool box) {
    if ((hit.lanes >> lane & 1U) == 0) return;
    const auto entry = static_cast<std::size_t>(hit.pair);
    const NarrowPair& pair = narrow(hit.pair, box);
    const int row_a = box ? set.boxes[entry].row_a : set.pairs[entry].row_a;
    const auto moves_a =
        static_cast<double>(a.inflation[static_cast<std::size_t>(row_a * kLanes) + lane]);
    s.undecided.push_back({hit.pair, box, static_cast<double>(hit.distance[lane]), moves_a,
                           static_cast<double>(hit.inflation[lane]) - moves_a, pair.limit_m,
                           excess(pair)});
  };
  for (std::size_t lane = 0; lane < count; ++lane) {
    s.undecided.clear();
    for (int h = 0; h < pairs; ++h) add(s.hits[static_cast<std::size_t>(h)], lane, false);
    for (int h = 0; h < boxes; ++h) add(s.box_hits[static_cast<std::size_t>(h)], lane, true);
    if (self) {
      for (const MotionTube::SelfHit& hit : a_->self_hits(at(open[lane].cell).a)) {
        const NarrowPair& pair = narrow(hit.pair, false);
        s.undecided.push_back({hit.pair, false, static_cast<double>(hit.distance),
                               static_cast<double>(hit.inflation), 0.0, pair.limit_m,
                               excess(pair)});
      }
    }
    decide(open[lane].cell);
  }
}

const LinkagePart& CoordinationDiagram::second_part(const NarrowPair& pair) const {
  const auto b = static_cast<std::size_t>(pair.part_b);
  if (still_ != nullptr) return still_->parts[b];
  return (b_ ? b_ : a_)->linkage().parts()[b];
}

double CoordinationDiagram::exact(const NarrowPair& pair, const double* frames_a,
                                  const double* frames_b, int stride, double limit_m) const {
  const LinkagePart& a = a_->linkage().parts()[static_cast<std::size_t>(pair.part_a)];
  const LinkagePart& b = second_part(pair);
  return part_distance(*setting_.bodies, a.part, part_pose(a, frames_a, stride), b.part,
                       part_pose(b, b_ ? frames_b : frames_a, stride), limit_m);
}

// Whether the pair keeps its limit all over the cell where the bodies that come into question are
// enough_m apart at its middle or do not come that close along their direction.
bool CoordinationDiagram::keeps_apart(const Cell& cell, const NarrowPair& pair, double limit_m,
                                      double enough_m) {
  const Linkage& arm = a_->linkage();
  const LinkagePart& a = arm.parts()[static_cast<std::size_t>(pair.part_a)];
  const LinkagePart& b = second_part(pair);
  const bool self = !b_ && still_ == nullptr;
  std::size_t common = 0;
  if (self) {
    const auto of_a = arm.ancestors(a.frame);
    const auto of_b = arm.ancestors(b.frame);
    common = static_cast<std::size_t>(std::ranges::mismatch(of_a, of_b).in1 - of_a.begin());
  }
  Scratch& s = *setting_.scratch;
  s.axes_b.clear();
  a_->axes_of(cell.a, a.frame, common, s.axes_a);
  if (self) a_->axes_of(cell.a, b.frame, common, s.axes_b);
  if (b_) b_->axes_of(cell.b, b.frame, 0, s.axes_b);
  const double* frames_a = a_->place_of(cell.a).frames();
  const double* frames_b = b_ ? b_->place_of(cell.b).frames() : frames_a;
  const std::vector<Part>& parts = setting_.bodies->parts;
  return keep_apart(setting_.bodies->bodies,
                    {{parts[a.part], part_pose(a, frames_a, kLanes)}, s.axes_a},
                    {{parts[b.part], part_pose(b, frames_b, kLanes)}, s.axes_b}, limit_m, enough_m);
}

const NarrowPair& CoordinationDiagram::narrow(int entry, bool box) const {
  const PairSet& set = *setting_.pairs;
  return box ? set.narrow_boxes[static_cast<std::size_t>(entry)]
             : set.narrow[static_cast<std::size_t>(entry)];
}

// Whether the pair keeps its limit all over the cell; notes it if not.
bool CoordinationDiagram::clears(Cell& cell, Undecided& u) {
  const NarrowPair& pair = narrow(u.narrow, u.box);
  const double enough_m = u.limit_m + u.moves_m();
  u.distance_m = exact(pair, a_->place_of(cell.a).frames(),
                       b_ ? b_->place_of(cell.b).frames() : nullptr, filter::kLanes, enough_m);
  u.slack_m = 0.0;
  if (u.distance_m >= enough_m) return true;
  if (u.distance_m - u.limit_m > kTowardsShare * u.moves_m() &&
      keeps_apart(cell, pair, u.limit_m, enough_m)) {
    return true;
  }
  note(cell, {pair.pair, u.narrow, u.box, u.distance_m});
  return false;
}

// From what the filter has left open to the cell's state.
void CoordinationDiagram::decide(int index) {
  std::vector<Undecided>& undecided = setting_.scratch->undecided;
  Cell& cell = at(index);
  cell.state = CellState::free;
  if (undecided.empty()) return;

  // What is in conflict all over the cell makes that of it; what is not clear splits it.
  const auto passes = [&](Undecided& u) {
    if (clears(cell, u)) return true;
    if (u.distance_m + u.moves_m() < u.limit_m) {
      cell.state = CellState::conflict;
    } else {
      choose_split(cell, u);
    }
    return false;
  };
  // By the capsules, a conflict most likely: unless the one is in a notch of the other.
  const auto closest = std::ranges::min_element(
      undecided, {}, [](const Undecided& u) { return u.distance_m + u.slack_m - u.limit_m; });
  if (closest->distance_m + closest->slack_m < closest->limit_m && !passes(*closest)) return;
  // The largest distance that a pair may have, as far as the capsules tell: what is inside of them
  // is not farther from the body than they stand off.
  const auto room = [](const Undecided& u) {
    return std::max(u.distance_m, 0.0) + u.slack_m - u.limit_m;
  };
  const auto worst = std::ranges::min_element(
      undecided, {}, [&](const Undecided& u) { return room(u) - u.moves_m(); });
  if (room(*worst) < kTowardsShare * worst->moves_m()) {  // no distance would do: none is asked
    choose_split(cell, *worst);
    return;
  }
  std::iter_swap(undecided.begin(), worst);  // mostly it is the one that does not
  for (Undecided& u : undecided) {
    if (!passes(u)) return;
  }
}

// Keeps the closest pair of a cell's middle.
void CoordinationDiagram::note(Cell& cell, const Found& found) {
  if (cell.finding < 0) {
    cell.finding = static_cast<int>(found_.size());
    found_.push_back(found);
  } else if (found.distance_m < found_[static_cast<std::size_t>(cell.finding)].distance_m) {
    found_[static_cast<std::size_t>(cell.finding)] = found;
  }
}

void CoordinationDiagram::choose_split(Cell& cell, const Undecided& worst) {
  cell.split_a = worst.moves_a_m >= kBothShare * worst.moves_b_m;
  cell.split_b = b_ && worst.moves_b_m >= kBothShare * worst.moves_a_m;
  if (!(cell.split_a && a_->width(cell.a) > kFinest) &&
      !(cell.split_b && b_->width(cell.b) > kFinest)) {
    cell.split_a = cell.split_b = true;  // what is left
  }
  const double room_m = worst.distance_m + worst.slack_m - worst.limit_m;
  const double shrink = room_m > 0.0 ? worst.moves_m() / room_m : 2.0;
  cell.levels = shrink > 6.0 ? 2 : 1;
  cell.state = can_split(cell) ? CellState::mixed : CellState::finest;
}

}  // namespace armloom
