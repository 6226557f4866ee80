#include "core/collision/check/conflict_regions.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/base/disjoint_sets.h"

namespace armloom {
namespace {

// One axis cut wherever a cell begins or ends. Cuts no farther apart than kTouch are one, and
// columns reach from the first of their cut to the last of the next.
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

  // An axis without width has one column all the same.
  [[nodiscard]] int columns() const { return std::max(1, static_cast<int>(first_.size()) - 1); }
  [[nodiscard]] Duration from(int column) const { return first_[index(column)]; }
  [[nodiscard]] Duration to(int column) const {
    return last_[std::min(index(column) + 1, last_.size() - 1)];
  }
  // The first column that begins at the cut or behind it.
  [[nodiscard]] int place(Duration cut) const {
    return static_cast<int>(std::ranges::lower_bound(last_, cut) - last_.begin());
  }

 private:
  [[nodiscard]] static std::size_t index(int column) { return static_cast<std::size_t>(column); }
  std::vector<Duration> first_, last_;
};

struct Span {
  int from_a, to_a, from_b, to_b;  // columns, the last one not included
};

// Columns of both axes with a mark in each field.
class Grid {
 public:
  enum : int { kFree = -1, kSolid = -2 };  // else: a component

  Grid(Axis a, Axis b)
      : a_(std::move(a)),
        b_(std::move(b)),
        marks_(static_cast<std::size_t>(a_.columns()) * static_cast<std::size_t>(b_.columns()),
               kFree) {}

  [[nodiscard]] int& at(int a, int b) {
    return marks_[static_cast<std::size_t>(a) * static_cast<std::size_t>(b_.columns()) +
                  static_cast<std::size_t>(b)];
  }
  [[nodiscard]] const Axis& a() const { return a_; }
  [[nodiscard]] const Axis& b() const { return b_; }

  [[nodiscard]] Span span_of(const ProgressBox& box) const {
    const int from_a = std::min(a_.place(box.from_a), a_.columns() - 1);
    const int from_b = std::min(b_.place(box.from_b), b_.columns() - 1);
    return {from_a, std::max(from_a + 1, a_.place(box.to_a)), from_b,
            std::max(from_b + 1, b_.place(box.to_b))};
  }
  void fill(const Span& span, int mark) {
    for (int i = span.from_a; i < span.to_a; ++i) {
      std::fill(&at(i, span.from_b), &at(i, span.to_b - 1) + 1, mark);
    }
  }

 private:
  Axis a_, b_;
  std::vector<int> marks_;
};

// The fields of one mark, column of A by column, as runs along B; runs that hang together are one
// set, named by its first run.
class Runs {
 public:
  Runs(Grid& grid, int mark, bool corners) {
    const int reach = corners ? 1 : 0;
    std::size_t before = 0;  // first run of the column before
    for (int i = 0; i < grid.a().columns(); ++i) {
      const std::size_t begin = spans_.size();
      for (int j = 0; j < grid.b().columns();) {
        int end = j + 1;
        const bool wanted = grid.at(i, j) == mark;
        while (end < grid.b().columns() && (grid.at(i, end) == mark) == wanted) ++end;
        if (wanted) spans_.push_back({i, i + 1, j, end});
        j = end;
      }
      for (std::size_t r = begin; r < spans_.size(); ++r) sets_.add();
      for (std::size_t x = before, y = begin; x < begin && y < spans_.size();) {
        const bool touch =
            spans_[x].from_b < spans_[y].to_b + reach && spans_[y].from_b < spans_[x].to_b + reach;
        if (touch) sets_.join(x, y);
        spans_[x].to_b < spans_[y].to_b ? ++x : ++y;
      }
      before = begin;
    }
  }

  [[nodiscard]] const std::vector<Span>& spans() const { return spans_; }
  [[nodiscard]] std::size_t root(std::size_t run) { return sets_.root(run); }

 private:
  std::vector<Span> spans_;
  DisjointSets sets_;
};

Grid grid_of(const std::vector<BlockedCell>& cells, const std::vector<std::size_t>& ahead,
             const ProgressBox& remaining) {
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

// What is free and closed in on all sides becomes solid.
void fill_holes(Grid& grid, const ProgressBox& remaining) {
  Runs free(grid, Grid::kFree, false);
  std::vector<bool> outside(free.spans().size(), false);
  for (std::size_t r = 0; r < outside.size(); ++r) {
    const Span& s = free.spans()[r];
    const bool rim = s.from_a == 0 || s.to_a == grid.a().columns() || s.from_b == 0 ||
                     s.to_b == grid.b().columns();
    const bool reached =
        grid.a().from(s.from_a) <= remaining.from_a && grid.b().from(s.from_b) <= remaining.from_b;
    if (rim || reached) outside[free.root(r)] = true;
  }
  for (std::size_t r = 0; r < outside.size(); ++r) {
    if (!outside[free.root(r)]) grid.fill(free.spans()[r], Grid::kSolid);
  }
}

// Marks the solid fields with their components; returns how many there are.
std::size_t mark_components(Grid& grid) {
  Runs solid(grid, Grid::kSolid, true);
  std::vector<int> component(solid.spans().size(), -1);
  int count = 0;
  for (std::size_t r = 0; r < component.size(); ++r) {
    const std::size_t root = solid.root(r);  // not behind r
    if (root == r) component[r] = count++;
    grid.fill(solid.spans()[r], component[root]);
  }
  return static_cast<std::size_t>(count);
}

// The rectangles of every component. `along_a`: first joined along A, then along B.
std::vector<std::vector<Span>> spans_of(Grid& grid, std::size_t components, bool along_a) {
  const int lines = along_a ? grid.b().columns() : grid.a().columns();
  const int places = along_a ? grid.a().columns() : grid.b().columns();
  const auto mark = [&](int line, int place) {
    return along_a ? grid.at(place, line) : grid.at(line, place);
  };
  std::vector<std::vector<Span>> spans(components);
  struct Run {  // open: reaches to the line at hand
    int from, to, component, since;
  };
  std::vector<Run> open, now;
  for (int line = 0; line <= lines; ++line) {
    now.clear();
    for (int p = 0; line < lines && p < places;) {
      const int component = mark(line, p);
      int end = p + 1;
      while (end < places && mark(line, end) == component) ++end;
      if (component >= 0) now.push_back({p, end, component, line});
      p = end;
    }
    for (const Run& run : open) {
      const auto same = std::ranges::find_if(
          now, [&](const Run& other) { return other.from == run.from && other.to == run.to; });
      if (same != now.end()) {
        same->since = run.since;
        continue;
      }
      spans[static_cast<std::size_t>(run.component)].push_back(
          along_a ? Span{run.from, run.to, run.since, line}
                  : Span{run.since, line, run.from, run.to});
    }
    std::swap(open, now);
  }
  return spans;
}

Duration::rep area_of(const ProgressBox& box) {
  // In microseconds: the square of nanoseconds would run over after some seconds.
  const auto width = [](Duration from, Duration to) { return (to - from).count() / 1000 + 1; };
  return width(box.from_a, box.to_a) * width(box.from_b, box.to_b);
}

// Whether x tells more than y.
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
  Grid grid = grid_of(cells, ahead, remaining);
  std::vector<Span> spans;
  for (const std::size_t i : ahead) {
    spans.push_back(grid.span_of(cells[i].box));
    grid.fill(spans.back(), Grid::kSolid);
  }
  fill_holes(grid, remaining);
  std::vector<BlockedRegion> regions(mark_components(grid), {{}, cells.size()});
  const auto along_a = spans_of(grid, regions.size(), true);
  const auto along_b = spans_of(grid, regions.size(), false);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (const Span& s : along_a[r].size() < along_b[r].size() ? along_a[r] : along_b[r]) {
      regions[r].boxes.push_back({grid.a().from(s.from_a), grid.a().to(s.to_a - 1),
                                  grid.b().from(s.from_b), grid.b().to(s.to_b - 1)});
    }
    std::ranges::sort(regions[r].boxes, {}, place_of);
  }
  for (std::size_t k = 0; k < ahead.size(); ++k) {
    const std::size_t i = ahead[k];
    const int component = grid.at(spans[k].from_a, spans[k].from_b);
    BlockedRegion& region = regions[static_cast<std::size_t>(component)];
    const bool first = region.evidence == cells.size();
    if (first || tells_more(cells[i], cells[region.evidence])) region.evidence = i;
  }
  std::ranges::sort(regions, {},
                    [](const BlockedRegion& region) { return place_of(region.boxes.front()); });
  return regions;
}

}  // namespace armloom
