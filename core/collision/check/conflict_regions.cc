#include "core/collision/check/conflict_regions.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/collision/check/field_runs.h"

namespace armloom {
namespace {

// One axis of the diagram, cut into columns at the edges of all cells. A column of A and a column
// of B form a field. Cuts within kTouch of each other are merged into one. A column includes all
// cuts that were merged at its beginning and at its end.
class Axis {
 public:
  explicit Axis(std::vector<Duration> cuts) {
    std::ranges::sort(cuts);
    for (const Duration cut : cuts) {
      if (first_.empty() || cut - last_.back() > kTouch) {
        first_.push_back(cut);
        last_.push_back(cut);
      } else {
        last_.back() = cut;
      }
    }
  }

  // An axis of zero width has one column.
  [[nodiscard]] int columns() const { return std::max(1, static_cast<int>(first_.size()) - 1); }
  [[nodiscard]] Duration from(int column) const { return first_[index(column)]; }
  [[nodiscard]] Duration to(int column) const {
    return last_[std::min(index(column) + 1, last_.size() - 1)];
  }
  // Returns the first column at or after the cut.
  [[nodiscard]] int place(Duration cut) const {
    return static_cast<int>(std::ranges::lower_bound(last_, cut) - last_.begin());
  }

 private:
  [[nodiscard]] static std::size_t index(int column) { return static_cast<std::size_t>(column); }
  std::vector<Duration> first_, last_;
};

Span span_of(const Axis& axis_a, const Axis& axis_b, const ProgressBox& box) {
  const int from_a = std::min(axis_a.place(box.from_a), axis_a.columns() - 1);
  const int from_b = std::min(axis_b.place(box.from_b), axis_b.columns() - 1);
  return {from_a, std::max(from_a + 1, axis_a.place(box.to_a)), from_b,
          std::max(from_b + 1, axis_b.place(box.to_b))};
}

std::pair<Axis, Axis> axes_of(const std::vector<BlockedCell>& cells,
                              const std::vector<std::size_t>& ahead, const ProgressBox& remaining) {
  std::vector<Duration> a, b;
  for (const std::size_t i : ahead) {
    const ProgressBox& box = cells[i].box;
    a.insert(a.end(), {box.from_a, box.to_a});
    b.insert(b.end(), {box.from_b, box.to_b});
  }
  const auto cut_at = [](std::vector<Duration>& cuts, Duration now) {
    const auto [least, most] = std::ranges::minmax(cuts);
    if (least < now && now < most) cuts.push_back(now);
  };
  cut_at(a, remaining.from_a);
  cut_at(b, remaining.from_b);
  return {Axis(std::move(a)), Axis(std::move(b))};
}

// Returns the free fields that blocked fields enclose, as rectangles.
std::vector<Span> holes_of(const Lines& solid, const Axis& axis_a, const Axis& axis_b,
                           const ProgressBox& remaining) {
  const Lines free = solid.gaps();
  ConnectedRuns runs(free, false);
  std::vector<bool> outside(runs.size(), false);
  const auto each_run = [&](const auto& take) {
    for (int line = 0; line < free.count(); ++line) {
      for (std::size_t r = 0; r < free.at(line).size(); ++r) {
        take(line, free.at(line)[r], runs.root(runs.first(line) + r));
      }
    }
  };
  each_run([&](int line, const Run& run, std::size_t root) {
    const bool rim =
        line == 0 || line + 1 == free.count() || run.from == 0 || run.to == free.places();
    const bool reached =
        axis_a.from(line) <= remaining.from_a && axis_b.from(run.from) <= remaining.from_b;
    if (rim || reached) outside[root] = true;
  });
  Lines closed_in(free.count(), free.places());
  each_run([&](int line, const Run& run, std::size_t root) {
    if (!outside[root]) closed_in.at(line).push_back(run);
  });
  std::vector<Span> holes;
  each_rectangle(closed_in, [&](const Span& hole) { holes.push_back(hole); });
  return holes;
}

class SolidFields {
 public:
  SolidFields(const std::vector<Span>& cells, const Axis& axis_a, const Axis& axis_b,
              const ProgressBox& remaining)
      : along_b_(axis_a.columns(), axis_b.columns()), along_a_(axis_b.columns(), axis_a.columns()) {
    for (const Span& cell : cells) along_b_.add(cell);
    along_b_.join();
    const std::vector<Span> holes = holes_of(along_b_, axis_a, axis_b, remaining);
    for (const Span& hole : holes) along_b_.add(hole);
    along_b_.join();
    for (const auto* spans : {&cells, &holes}) {
      for (const Span& span : *spans) along_a_.add(turned(span));
    }
    along_a_.join();
    mark_components();
  }

  [[nodiscard]] std::size_t components() const { return components_; }
  [[nodiscard]] std::size_t component_at(int a, int b) const {
    const std::vector<Run>& runs = along_b_.at(a);
    const auto behind = std::ranges::upper_bound(runs, b, {}, &Run::from);
    return component_of(a, static_cast<std::size_t>(behind - runs.begin()) - 1);
  }
  // Returns rectangles that cover each component. If `along_a`, fields are joined along A first,
  // else along B.
  [[nodiscard]] std::vector<std::vector<Span>> rectangles(bool along_a) const {
    std::vector<std::vector<Span>> spans(components_);
    const auto take = [&](const Span& span) {
      const Span found = along_a ? turned(span) : span;
      spans[component_at(found.from_a, found.from_b)].push_back(found);
    };
    each_rectangle(along_a ? along_a_ : along_b_, take);
    return spans;
  }

 private:
  [[nodiscard]] std::size_t component_of(int line, std::size_t run) const {
    return component_[first_[static_cast<std::size_t>(line)] + run];
  }
  void mark_components() {
    ConnectedRuns runs(along_b_, true);
    for (int line = 0; line < along_b_.count(); ++line) first_.push_back(runs.first(line));
    component_.resize(runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const std::size_t root = runs.root(r);  // root <= r
      component_[r] = root == r ? components_++ : component_[root];
    }
  }

  Lines along_b_;                       // one line per column of A
  Lines along_a_;                       // one line per column of B
  std::vector<std::size_t> first_;      // by line of along_b_: number of its first run
  std::vector<std::size_t> component_;  // by number of a run of along_b_
  std::size_t components_ = 0;
};

Duration::rep area_of(const ProgressBox& box) {
  // In microseconds, because squared nanoseconds overflow after some seconds.
  const auto width = [](Duration from, Duration to) { return (to - from).count() / 1000 + 1; };
  return width(box.from_a, box.to_a) * width(box.from_b, box.to_b);
}

// Returns true if x is better evidence than y.
bool tells_more(const BlockedCell& x, const BlockedCell& y) {
  if (x.evidence != y.evidence) return x.evidence > y.evidence;
  if (x.evidence == BlockedCell::Evidence::none) return area_of(x.box) > area_of(y.box);
  return x.distance_m < y.distance_m;
}

std::tuple<Duration, Duration> place_of(const ProgressBox& box) { return {box.from_a, box.from_b}; }

}  // namespace

std::vector<BlockedRegion> blocked_regions(const std::vector<BlockedCell>& cells,
                                           const ProgressBox& remaining) {
  std::vector<std::size_t> ahead;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ProgressBox& box = cells[i].box;
    const auto behind = [](Duration to, Duration now, Duration end) {
      return to < now && to < end;
    };
    if (behind(box.to_a, remaining.from_a, remaining.to_a)) continue;
    if (!behind(box.to_b, remaining.from_b, remaining.to_b)) ahead.push_back(i);
  }
  if (ahead.empty()) return {};
  const auto [axis_a, axis_b] = axes_of(cells, ahead, remaining);
  std::vector<Span> spans;
  for (const std::size_t i : ahead) spans.push_back(span_of(axis_a, axis_b, cells[i].box));
  const SolidFields solid(spans, axis_a, axis_b, remaining);
  std::vector<BlockedRegion> regions(solid.components(), {{}, cells.size()});
  const auto along_a = solid.rectangles(true);
  const auto along_b = solid.rectangles(false);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (const Span& s : along_a[r].size() < along_b[r].size() ? along_a[r] : along_b[r]) {
      regions[r].boxes.push_back({axis_a.from(s.from_a), axis_a.to(s.to_a - 1),
                                  axis_b.from(s.from_b), axis_b.to(s.to_b - 1)});
    }
    std::ranges::sort(regions[r].boxes, {}, place_of);
  }
  for (std::size_t k = 0; k < ahead.size(); ++k) {
    const std::size_t i = ahead[k];
    BlockedRegion& region = regions[solid.component_at(spans[k].from_a, spans[k].from_b)];
    const bool first = region.evidence == cells.size();
    if (first || tells_more(cells[i], cells[region.evidence])) region.evidence = i;
  }
  std::ranges::sort(regions, {},
                    [](const BlockedRegion& region) { return place_of(region.boxes.front()); });
  return regions;
}

}  // namespace armloom
