#include "core/collision/coordination_diagram.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/collision/filter/kernels.h"

namespace armloom {
namespace {

constexpr int kLanes = filter::kLanes;

// Wider stretches of a motion are hardly ever free in one: they are halved unseen.
constexpr Duration kWide = std::chrono::milliseconds(700);

// A side is halved together with the other if it moves at least this share as much.
constexpr double kBothShare = 0.5;

struct Frames {
  std::vector<double> a;
  std::vector<double> b;
  std::vector<double> q;
};

}  // namespace

// One side of a batch of cells that lie apart.
struct CoordinationDiagram::Gathered {
  std::vector<float> capsules;   // [capsule][6][kLanes]
  std::vector<float> inflation;  // [capsule][kLanes]
  std::vector<float> ball;       // [4][kLanes]
};

struct CoordinationDiagram::Scratch {
  Gathered a, b;
  std::vector<filter::Hit> hits, box_hits;
  std::vector<Undecided> undecided;  // of one cell
  Frames point;
  std::vector<int> nodes;
};

// A pair that the filter leaves open in a cell.
struct CoordinationDiagram::Undecided {
  int narrow;  // in PairSet::narrow, or narrow_boxes
  bool box;
  double distance_m;  // lower bound at the middle
  double moves_a_m;   // during the cell
  double moves_b_m;
  double limit_m;
  double slack_m;  // by how much the exact distance may be above the bound

  [[nodiscard]] double moves_m() const { return moves_a_m + moves_b_m; }
};

// One question on its way.
struct CoordinationDiagram::Search {
  const Region& region;
  std::uint64_t budget;
  std::vector<Open> open;
  Answer answer;
  double conflict_at_s = Region::kUnbounded;   // of the earliest that is proven
  double undecided_at_s = Region::kUnbounded;  // of the earliest cell that cannot be refined
  int undecided = -1;
};

CoordinationDiagram::CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a,
                                         std::shared_ptr<MotionTube> b)
    : setting_(setting), a_(std::move(a)), b_(std::move(b)), scratch_(std::make_shared<Scratch>()) {
  cells_.reserve(128);
  cells_.push_back({MotionTube::root(), MotionTube::root()});
  Scratch& s = *scratch_;
  const auto make_room = [](const MotionTube& tube, Gathered& gathered) {
    const std::size_t size = tube.linkage().capsules().size() * static_cast<std::size_t>(kLanes);
    gathered.capsules.resize(size * 6);
    gathered.inflation.resize(size);
    gathered.ball.resize(4 * static_cast<std::size_t>(kLanes));
  };
  make_room(*a_, s.a);
  s.point.a.resize(a_->linkage().frames().size() * 12);
  s.point.q.resize(a_->linkage().joints().size());
  s.hits.resize(setting_.pairs->pairs.size() + 1);
  s.box_hits.resize(setting_.pairs->boxes.size() + 1);
  if (!b_) return;
  make_room(*b_, s.b);
  s.point.b.resize(b_->linkage().frames().size() * 12);
  s.point.q.resize(std::max(s.point.q.size(), b_->linkage().joints().size()));
}

CoordinationDiagram::CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a,
                                         const StillParts& still)
    : CoordinationDiagram(setting, std::move(a), std::shared_ptr<MotionTube>()) {
  still_ = &still;
}

CoordinationDiagram::CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a)
    : CoordinationDiagram(setting, std::move(a), std::shared_ptr<MotionTube>()) {}

CoordinationDiagram CoordinationDiagram::with(Setting setting) const {
  CoordinationDiagram other(setting, a_, b_);
  other.still_ = still_;
  return other;
}

// ---- The tree ----

std::optional<TimeRange> CoordinationDiagram::meets(const Region& region, const Cell& cell) const {
  const double b1 = b_ ? to_seconds(b_->from(cell.b)) : 0.0;
  const double b2 = b_ ? to_seconds(b_->to(cell.b)) : 0.0;
  return armloom::meets(region, to_seconds(a_->from(cell.a)), to_seconds(a_->to(cell.a)), b1, b2);
}

bool CoordinationDiagram::too_wide(const Cell& cell) const {
  return a_->width(cell.a) > kWide || (b_ && b_->width(cell.b) > kWide);
}

bool CoordinationDiagram::can_split(const Cell& cell) const {
  return a_->width(cell.a) > kFinest || (b_ && b_->width(cell.b) > kFinest);
}

// As the cell's split_a, split_b say; children of further levels likewise.
void CoordinationDiagram::split(int index, int levels) {
  const Cell cell = at(index);
  const bool split_a = cell.split_a && a_->width(cell.a) > kFinest;
  const bool split_b = cell.split_b && b_ && b_->width(cell.b) > kFinest;
  if (!split_a && !split_b) {
    at(index).state = CellState::finest;
    return;
  }
  const int children = static_cast<int>(cells_.size());
  at(index).children = children;
  at(index).state = CellState::inner;
  at(index).split_a = split_a;
  at(index).split_b = split_b;
  const int first_a = split_a ? a_->first_child(cell.a) : cell.a;
  const int first_b = split_b ? b_->first_child(cell.b) : cell.b;
  for (int i = 0; i < (split_a ? 2 : 1); ++i) {
    for (int j = 0; j < (split_b ? 2 : 1); ++j) {
      Cell child{first_a + i, first_b + j};
      child.split_a = cell.split_a;
      child.split_b = cell.split_b;
      cells_.push_back(child);
    }
  }
  if (levels <= 1) return;
  const int end = static_cast<int>(cells_.size());
  for (int child = children; child < end; ++child) {
    if (can_split(at(child))) split(child, levels - 1);
  }
}

// Adds the unknown leaves below the cell that the question needs; takes note of what is known.
void CoordinationDiagram::collect(int index, Search& search) {
  const auto times = meets(search.region, at(index));
  if (!times || times->from > search.conflict_at_s - kFirst_s) return;
  if (at(index).state == CellState::free) return;
  const Open open{index, *times};
  if (at(index).state == CellState::unknown && too_wide(at(index))) {
    Cell& cell = at(index);
    cell.split_a = a_->width(cell.a) > kWide;
    cell.split_b = b_ && b_->width(cell.b) > kWide;
    split(index, 1);
  }
  if (at(index).state == CellState::mixed || at(index).state == CellState::conflict) {
    consider_conflict(open, search);
    if (times->from > search.conflict_at_s - kFirst_s) return;
    if (at(index).state == CellState::mixed) split(index, at(index).levels);
  }
  switch (at(index).state) {
    case CellState::unknown:
      search.open.push_back(open);
      break;
    case CellState::conflict:  // none of whose states is known to be the region's: still not free
      if (search.conflict_at_s <= times->to) break;
      [[fallthrough]];
    case CellState::finest:
      if (times->from < search.undecided_at_s) {
        search.undecided_at_s = times->from;
        search.undecided = index;
      }
      break;
    case CellState::inner: {
      const Cell cell = at(index);
      const int count = (cell.split_a ? 2 : 1) * (cell.split_b ? 2 : 1);
      for (int i = 0; i < count; ++i) collect(cell.children + i, search);
      break;
    }
    default:
      break;
  }
}

// ---- The question ----

CoordinationDiagram::Answer CoordinationDiagram::ask(const Region& region, std::uint64_t budget) {
  Search search{.region = region, .budget = budget, .open = {}, .answer = {}};
  Answer& answer = search.answer;
  std::vector<Open> now;
  collect(0, search);
  while (!search.open.empty()) {
    std::swap(now, search.open);
    search.open.clear();
    for (std::size_t done = 0; done < now.size();) {
      if (answer.evaluations >= budget) {
        answer.exhausted = true;
        for (std::size_t i = done; i < now.size(); ++i) {
          if (now[i].times.from >= search.undecided_at_s) continue;
          search.undecided_at_s = now[i].times.from;
          search.undecided = now[i].cell;
        }
        break;
      }
      const std::size_t left =
          std::min<std::size_t>(now.size() - done, budget - answer.evaluations);
      const std::size_t count = std::min<std::size_t>(kLanes, left);
      evaluate(now.data() + done, count);
      answer.evaluations += count;
      done += count;
    }
    if (answer.exhausted) break;
    for (const Open& open : now) collect(open.cell, search);
  }
  const bool undecided = search.undecided_at_s < search.conflict_at_s - kFirst_s;
  answer.proven = answer.conflict.has_value();
  answer.free = !undecided && !answer.proven;
  if (undecided && !answer.proven) {
    const Cell& cell = at(search.undecided);
    const Duration time_a = a_->middle(cell.a);
    const Duration time_b = b_ ? b_->middle(cell.b) : Duration{};
    const Close closest = closest_at(time_a, time_b);
    const Finding finding{closest.pair, closest.distance_m, time_a, time_b, search.undecided_at_s};
    answer.conflict = finding;
  }
  return answer;
}

std::uint64_t CoordinationDiagram::refine(const Region& region, Duration resolution,
                                          std::uint64_t budget) {
  std::vector<Open> open{{0, {0.0, 0.0}}};
  std::vector<Open> unknown;
  std::uint64_t looked_at = 0;
  while (!open.empty()) {
    unknown.clear();
    for (std::size_t i = 0; i < open.size(); ++i) {  // grows
      const int index = open[i].cell;
      if (!meets(region, at(index))) continue;
      Cell& cell = at(index);
      const bool wide = a_->width(cell.a) > resolution || (b_ && b_->width(cell.b) > resolution);
      if (cell.state == CellState::unknown && !too_wide(cell)) unknown.push_back(open[i]);
      if (cell.state == CellState::unknown && too_wide(cell)) {
        cell.split_a = a_->width(cell.a) > kWide;
        cell.split_b = b_ && b_->width(cell.b) > kWide;
        split(index, 1);
      } else if (cell.state == CellState::mixed && wide) {
        split(index, 1);
      }
      const Cell now = at(index);
      if (now.state != CellState::inner) continue;
      const int count = (now.split_a ? 2 : 1) * (now.split_b ? 2 : 1);
      for (int c = 0; c < count; ++c) open.push_back({now.children + c, {0.0, 0.0}});
    }
    for (std::size_t done = 0; done < unknown.size(); done += kLanes) {
      if (looked_at >= budget) return looked_at;
      const std::size_t count = std::min<std::size_t>(kLanes, unknown.size() - done);
      evaluate(unknown.data() + done, count);
      looked_at += count;
    }
    open = unknown;
  }
  return looked_at;
}

// A cell with a conflict at its middle: is that, or what the plan passes in the cell, one of the
// question's region?
void CoordinationDiagram::consider_conflict(const Open& open, Search& search) {
  const Cell cell = at(open.cell);
  if (cell.finding < 0) return;
  const Found found = found_[static_cast<std::size_t>(cell.finding)];
  if (found.distance_m >= narrow(found.narrow, found.box).limit_m) return;
  const Duration time_a = a_->middle(cell.a);
  const Duration time_b = b_ ? b_->middle(cell.b) : Duration{};
  std::optional<Finding> finding;
  if (const auto at_s = first_at(search.region, to_seconds(time_a), to_seconds(time_b))) {
    finding = Finding{found.pair, found.distance_m, time_a, time_b, *at_s};
  } else if (search.answer.evaluations < search.budget) {
    ++search.answer.evaluations;
    finding = on_the_line(open, search.region);
  }
  if (!finding || finding->at_s >= search.conflict_at_s) return;
  search.conflict_at_s = finding->at_s;
  search.answer.conflict = finding;
}

void CoordinationDiagram::place_point(Duration time_a, Duration time_b) {
  Frames& point = scratch_->point;
  a_->configuration(time_a, point.q.data());
  place_frames(a_->linkage(), point.q.data(), point.a.data());
  if (!b_) return;
  b_->configuration(time_b, point.q.data());
  place_frames(b_->linkage(), point.q.data(), point.b.data());
}

std::vector<CoordinationDiagram::Close> CoordinationDiagram::too_close_at(Duration time_a,
                                                                          Duration time_b) {
  place_point(time_a, time_b);
  std::vector<Close> close;
  const auto look = [&](const std::vector<NarrowPair>& pairs) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (i > 0 && pairs[i].pair == pairs[i - 1].pair) continue;  // another capsule of the same
      const Frames& point = scratch_->point;
      const double distance_m =
          exact(pairs[i], point.a.data(), point.b.data(), 1, pairs[i].limit_m);
      if (distance_m < pairs[i].limit_m) close.push_back({pairs[i].pair, distance_m});
    }
  };
  look(setting_.pairs->narrow);
  look(setting_.pairs->narrow_boxes);
  return close;
}

CoordinationDiagram::Close CoordinationDiagram::closest_at(Duration time_a, Duration time_b) {
  place_point(time_a, time_b);
  Close closest{PairId{0}, Region::kUnbounded};
  for (const std::vector<NarrowPair>* pairs :
       {&setting_.pairs->narrow, &setting_.pairs->narrow_boxes}) {
    for (const NarrowPair& pair : *pairs) {
      const Frames& point = scratch_->point;
      const double distance_m = exact(pair, point.a.data(), point.b.data(), 1, closest.distance_m);
      if (distance_m < closest.distance_m) closest = {pair.pair, distance_m};
    }
  }
  return closest;
}

// The state that the plan itself passes in the middle of its time in the cell.
std::optional<CoordinationDiagram::Finding> CoordinationDiagram::on_the_line(const Open& open,
                                                                             const Region& region) {
  const Cell cell = at(open.cell);
  const Found found = found_[static_cast<std::size_t>(cell.finding)];
  const NarrowPair& pair = narrow(found.narrow, found.box);
  const double until = std::min(open.times.to, open.times.from + to_seconds(a_->duration()) +
                                                   (b_ ? to_seconds(b_->duration()) : 0.0));
  const double t = 0.5 * (open.times.from + until);
  const auto place = [t](const MotionTube& tube, int node, double progress) {
    const Duration planned = std::clamp(from_seconds(progress + t), Duration{}, tube.duration());
    return std::clamp(planned, tube.from(node), tube.to(node));
  };
  Finding finding{found.pair, 0.0, place(*a_, cell.a, region.progress_a), Duration{}, 0.0};
  if (b_) finding.time_b = place(*b_, cell.b, region.progress_b);
  const auto at_s = first_at(region, to_seconds(finding.time_a), to_seconds(finding.time_b));
  if (!at_s) return std::nullopt;
  finding.at_s = *at_s;
  place_point(finding.time_a, finding.time_b);
  const Frames& point = scratch_->point;
  finding.distance_m = exact(pair, point.a.data(), point.b.data(), 1, pair.limit_m);
  return finding.distance_m < pair.limit_m ? std::optional(finding) : std::nullopt;
}

// ---- One batch of cells ----

// The nodes of the cells as one side: the block itself where they are one.
filter::Side CoordinationDiagram::gather(const MotionTube& tube, int Cell::*node, const Open* open,
                                         std::size_t count, Gathered& to) {
  const MotionTube::Place first = tube.place_of(at(open[0].cell).*node);
  bool together = first.lane == 0;
  for (std::size_t lane = 1; together && lane < count; ++lane) {
    const MotionTube::Place place = tube.place_of(at(open[lane].cell).*node);
    together = place.block == first.block && place.lane == lane;
  }
  if (together) {
    return {first.block->capsules.data(), first.block->inflation.data(), first.block->ball.data()};
  }
  const std::size_t capsules = tube.linkage().capsules().size();
  const auto copy = [](const float* from, float* to_lane, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i) to_lane[i * kLanes] = from[i * kLanes];
  };
  for (std::size_t lane = 0; lane < count; ++lane) {
    const MotionTube::Place place = tube.place_of(at(open[lane].cell).*node);
    copy(place.block->capsules.data() + place.lane, to.capsules.data() + lane, capsules * 6);
    copy(place.block->inflation.data() + place.lane, to.inflation.data() + lane, capsules);
    copy(place.block->ball.data() + place.lane, to.ball.data() + lane, 4);
  }
  return {to.capsules.data(), to.inflation.data(), to.ball.data()};
}

void CoordinationDiagram::evaluate(const Open* open, std::size_t count) {
  Scratch& s = *scratch_;
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
    a = gather(*a_, &Cell::a, open, count, s.a);
    const filter::Kernel& kernel = filter::best_kernel();
    const unsigned lanes = (1U << count) - 1U;
    const filter::Side b = b_ ? gather(*b_, &Cell::b, open, count, s.b)
                              : filter::Side{still_->lanes.data(), still_->at_rest.data(), nullptr};
    pairs = kernel.near_pairs(a, b, set.pairs.data(), static_cast<int>(set.pairs.size()),
                              set.grouped(), lanes, s.hits.data());
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

double CoordinationDiagram::exact(const NarrowPair& pair, const double* frames_a,
                                  const double* frames_b, int stride, double limit_m) const {
  const LinkagePart& a = a_->linkage().parts()[static_cast<std::size_t>(pair.part_a)];
  const bool self = !b_ && still_ == nullptr;
  const auto b = static_cast<std::size_t>(pair.part_b);
  const LinkagePart& part_b =
      b_ ? b_->linkage().parts()[b] : (self ? a_->linkage().parts()[b] : still_->parts[b]);
  return part_distance(*setting_.bodies, a.part, part_pose(a, frames_a, stride), part_b.part,
                       part_pose(part_b, self ? frames_a : frames_b, stride), limit_m);
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
  note(cell, {pair.pair, u.narrow, u.box, u.distance_m});
  return false;
}

// From what the filter has left open to the cell's state.
void CoordinationDiagram::decide(int index) {
  std::vector<Undecided>& undecided = scratch_->undecided;
  Cell& cell = at(index);
  cell.state = CellState::free;
  if (undecided.empty()) return;

  // The largest distance that a pair may have, as far as the capsules tell.
  const auto room = [](const Undecided& u) { return u.distance_m + u.slack_m - u.limit_m; };
  const auto closest = std::ranges::min_element(undecided, {}, room);
  const auto worst = std::ranges::min_element(
      undecided, {}, [&](const Undecided& u) { return room(u) - u.moves_m(); });
  if (room(*closest) < 0.0) {  // a conflict, most likely
    const bool clear = clears(cell, *closest);
    if (!clear && closest->distance_m + closest->moves_m() < closest->limit_m) {
      cell.state = CellState::conflict;
      return;
    }
    choose_split(cell, clear ? *worst : *closest);
    return;
  }
  if (room(*worst) < worst->moves_m()) {  // no distance would do: exact ones need not be asked
    choose_split(cell, *worst);
    return;
  }
  for (Undecided& u : undecided) {
    if (clears(cell, u)) continue;
    choose_split(cell, u);
    return;
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

std::vector<CoordinationDiagram::CellView> CoordinationDiagram::cells() const {
  std::vector<CellView> views;
  for (const Cell& cell : cells_) {
    if (cell.state == CellState::inner) continue;
    views.push_back({a_->from(cell.a), a_->to(cell.a), b_ ? b_->from(cell.b) : Duration{},
                     b_ ? b_->to(cell.b) : Duration{}, cell.state});
  }
  return views;
}

}  // namespace armloom
