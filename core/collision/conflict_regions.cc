#include "core/collision/conflict_regions.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>

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
  enum : int { kFree = -1, kOutside = -2, kSolid = -3 };  // else: a component

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
  void fill(const Span& span) {
    for (int i = span.from_a; i < span.to_a; ++i) {
      std::fill(&at(i, span.from_b), &at(i, span.to_b - 1) + 1, int{kSolid});
    }
  }

  // Gives `mark` to all fields of one kind that hang together with this one.
  void flood(int a, int b, int kind, int mark, bool corners) {
    if (at(a, b) != kind) return;
    at(a, b) = mark;
    open_.assign(1, {a, b});
    while (!open_.empty()) {
      const auto [i, j] = open_.back();
      open_.pop_back();
      for (int di = -1; di <= 1; ++di) {
        for (int dj = -1; dj <= 1; ++dj) {
          if (!corners && di != 0 && dj != 0) continue;
          const int x = i + di, y = j + dj;
          if (x < 0 || y < 0 || x >= a_.columns() || y >= b_.columns() || at(x, y) != kind)
            continue;
          at(x, y) = mark;
          open_.emplace_back(x, y);
        }
      }
    }
  }

 private:
  Axis a_, b_;
  std::vector<int> marks_;
  std::vector<std::pair<int, int>> open_;
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
  const int last_a = grid.a().columns() - 1;
  const int last_b = grid.b().columns() - 1;
  for (int i = 0; i <= last_a; ++i) {
    for (int j = 0; j <= last_b; ++j) {
      const bool rim = i == 0 || j == 0 || i == last_a || j == last_b;
      const bool reached =
          grid.a().from(i) <= remaining.from_a && grid.b().from(j) <= remaining.from_b;
      if (rim || reached) grid.flood(i, j, Grid::kFree, Grid::kOutside, false);
    }
  }
  for (int i = 0; i <= last_a; ++i) {
    for (int j = 0; j <= last_b; ++j) {
      if (grid.at(i, j) == Grid::kFree) grid.at(i, j) = Grid::kSolid;
    }
  }
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
      return to <= now && to < end;
    };
    if (behind(box.to_a, remaining.from_a, remaining.to_a)) continue;
    if (!behind(box.to_b, remaining.from_b, remaining.to_b)) ahead.push_back(i);
  }
  if (ahead.empty()) return {};
  Grid grid = grid_of(cells, ahead, remaining);
  for (const std::size_t i : ahead) grid.fill(grid.span_of(cells[i].box));
  fill_holes(grid, remaining);
  int components = 0;
  for (int i = 0; i < grid.a().columns(); ++i) {
    for (int j = 0; j < grid.b().columns(); ++j) {
      if (grid.at(i, j) == Grid::kSolid) grid.flood(i, j, Grid::kSolid, components++, true);
    }
  }
  std::vector<BlockedRegion> regions(static_cast<std::size_t>(components), {{}, cells.size()});
  const auto along_a = spans_of(grid, regions.size(), true);
  const auto along_b = spans_of(grid, regions.size(), false);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    for (const Span& s : along_a[r].size() < along_b[r].size() ? along_a[r] : along_b[r]) {
      regions[r].boxes.push_back({grid.a().from(s.from_a), grid.a().to(s.to_a - 1),
                                  grid.b().from(s.from_b), grid.b().to(s.to_b - 1)});
    }
    std::ranges::sort(regions[r].boxes, {}, place_of);
  }
  for (const std::size_t i : ahead) {
    const Span span = grid.span_of(cells[i].box);
    BlockedRegion& region = regions[static_cast<std::size_t>(grid.at(span.from_a, span.from_b))];
    const bool first = region.evidence == cells.size();
    if (first || tells_more(cells[i], cells[region.evidence])) region.evidence = i;
  }
  std::ranges::sort(regions, {},
                    [](const BlockedRegion& region) { return place_of(region.boxes.front()); });
  return regions;
}

}  // namespace armloom
