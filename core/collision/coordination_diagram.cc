#include "core/collision/coordination_diagram.h"

#include <algorithm>

#include "core/collision/coordination_diagram_impl.h"

namespace armloom {
namespace {

constexpr int kLanes = filter::kLanes;

}  // namespace

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
    : setting_(std::move(setting)), a_(std::move(a)), b_(std::move(b)) {
  cells_.push_back({MotionTube::root(), MotionTube::root()});
  Scratch& s = *setting_.scratch;
  const auto make_room = [](auto& of, std::size_t size) {
    if (of.size() < size) of.resize(size);
  };
  const auto make_room_for = [&](const MotionTube& tube, Gathered& gathered,
                                 std::vector<double>& frames) {
    const std::size_t size = tube.linkage().capsules().size() * static_cast<std::size_t>(kLanes);
    make_room(gathered.capsules, size * 6);
    make_room(gathered.inflation, size);
    make_room(gathered.ball, 4 * static_cast<std::size_t>(kLanes));
    make_room(gathered.bends, size);
    const std::size_t axes = tube.linkage().frames().size();
    make_room(gathered.axes, axes * 6 * static_cast<std::size_t>(kLanes));
    make_room(gathered.spans, axes * static_cast<std::size_t>(kLanes));
    make_room(frames, axes * 12);
    make_room(s.point.q, tube.linkage().joints().size());
  };
  make_room_for(*a_, s.a, s.point.a);
  if (b_) make_room_for(*b_, s.b, s.point.b);
  make_room(s.hits, setting_.pairs->pairs.size() + 1);
  make_room(s.box_hits, setting_.pairs->boxes.size() + 1);
}

std::shared_ptr<CoordinationDiagram::Scratch> CoordinationDiagram::make_scratch() {
  return std::make_shared<Scratch>();
}

CoordinationDiagram::CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a,
                                         const StillParts& still)
    : CoordinationDiagram(std::move(setting), std::move(a), std::shared_ptr<MotionTube>()) {
  still_ = &still;
}

CoordinationDiagram::CoordinationDiagram(Setting setting, std::shared_ptr<MotionTube> a)
    : CoordinationDiagram(std::move(setting), std::move(a), std::shared_ptr<MotionTube>()) {}

CoordinationDiagram CoordinationDiagram::with(Setting setting) const {
  CoordinationDiagram other(std::move(setting), a_, b_);
  other.still_ = still_;
  return other;
}

// ---- The tree ----

std::optional<TimeRange> CoordinationDiagram::meets(const Region& region, const Cell& cell) const {
  const double b1 = b_ ? to_seconds(b_->from(cell.b)) : 0.0;
  const double b2 = b_ ? to_seconds(b_->to(cell.b)) : 0.0;
  return armloom::meets(region, to_seconds(a_->from(cell.a)), to_seconds(a_->to(cell.a)), b1, b2);
}

// An unknown cell that is hardly free in one is split before it is looked at.
void CoordinationDiagram::split_if_wide(int index) {
  Cell& cell = at(index);
  if (cell.state != CellState::unknown) return;
  const bool wide_a = a_->width(cell.a) > kWide;
  const bool wide_b = b_ && b_->width(cell.b) > kWide;
  if (!wide_a && !wide_b) return;
  cell.split_a = wide_a;
  cell.split_b = wide_b;
  split(index, 1);
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
  split_if_wide(index);
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
      for (int i = 0; i < cell.child_count(); ++i) collect(cell.children + i, search);
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

bool CoordinationDiagram::wider(const Cell& cell, Duration resolution) const {
  return a_->width(cell.a) > resolution || (b_ && b_->width(cell.b) > resolution);
}

// Where the side that moves more is fine already, the other one is halved.
void CoordinationDiagram::split_if_coarse(int index, Duration resolution) {
  Cell& cell = at(index);
  if (cell.state != CellState::mixed || !wider(cell, resolution)) return;
  const bool coarse_a = a_->width(cell.a) > resolution;
  const bool coarse_b = b_ && b_->width(cell.b) > resolution;
  const bool as_chosen = (cell.split_a && coarse_a) || (cell.split_b && coarse_b);
  cell.split_a = coarse_a && (cell.split_a || !as_chosen);
  cell.split_b = coarse_b && (cell.split_b || !as_chosen);
  split(index, 1);
}

// The first of these, as far as the budget goes; returns how many.
std::uint64_t CoordinationDiagram::evaluate_all(const std::vector<Open>& open,
                                                std::uint64_t budget) {
  std::size_t done = 0;
  while (done < open.size() && done < budget) {
    const std::size_t count = std::min<std::size_t>(kLanes, open.size() - done);
    evaluate(open.data() + done, count);
    done += count;
  }
  return done;
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
      split_if_wide(index);
      if (at(index).state == CellState::unknown) unknown.push_back(open[i]);
      split_if_coarse(index, resolution);
      const Cell now = at(index);
      if (now.state != CellState::inner) continue;
      for (int c = 0; c < now.child_count(); ++c) open.push_back({now.children + c, {0.0, 0.0}});
    }
    looked_at += evaluate_all(unknown, budget - looked_at);
    if (looked_at >= budget) return looked_at;
    open = unknown;
  }
  return looked_at;
}

// The conflict at the cell's middle.
const CoordinationDiagram::Found* CoordinationDiagram::proven(const Cell& cell) const {
  if (cell.finding < 0) return nullptr;
  const Found& found = found_[static_cast<std::size_t>(cell.finding)];
  return found.distance_m < narrow(found.narrow, found.box).limit_m ? &found : nullptr;
}

// A cell with a conflict at its middle: is that, or what the plan passes in the cell, one of the
// question's region?
void CoordinationDiagram::consider_conflict(const Open& open, Search& search) {
  const Cell cell = at(open.cell);
  if (proven(cell) == nullptr) return;
  const Found found = *proven(cell);
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
  Scratch::Point& point = setting_.scratch->point;
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
      const Scratch::Point& point = setting_.scratch->point;
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
      const Scratch::Point& point = setting_.scratch->point;
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
  const Scratch::Point& point = setting_.scratch->point;
  finding.distance_m = exact(pair, point.a.data(), point.b.data(), 1, pair.limit_m);
  return finding.distance_m < pair.limit_m ? std::optional(finding) : std::nullopt;
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
