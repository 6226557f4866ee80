#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/disjoint_sets.h"

namespace armloom {

// A rectangle of fields, as half-open ranges of columns of A and of B. A column of A and a column
// of B form a field.
struct Span {
  int from_a, to_a, from_b, to_b;
};

[[nodiscard]] inline Span turned(const Span& span) {
  return {span.from_b, span.to_b, span.from_a, span.to_a};
}

// Consecutive fields of one line.
struct Run {
  int from, to;
};

// A set of fields, stored as the runs of each line. So the cost does not grow with the area. A line
// is one column of A, and its runs go along B; or A and B are exchanged.
class Lines {
 public:
  Lines(int lines, int places) : runs_(static_cast<std::size_t>(lines)), places_(places) {}

  void add(const Span& span) {
    for (int line = span.from_a; line < span.to_a; ++line)
      at(line).push_back({span.from_b, span.to_b});
  }
  // Sorts and joins the runs of each line, as the other functions require.
  void join() {
    for (std::vector<Run>& runs : runs_) {
      std::ranges::sort(runs, {}, &Run::from);
      std::size_t last = 0;
      for (std::size_t i = 1; i < runs.size(); ++i) {
        if (runs[i].from <= runs[last].to) {
          runs[last].to = std::max(runs[last].to, runs[i].to);
        } else {
          runs[++last] = runs[i];
        }
      }
      if (!runs.empty()) runs.resize(last + 1);
    }
  }
  // Returns the fields that are in no run.
  [[nodiscard]] Lines gaps() const {
    Lines gaps(count(), places_);
    for (int line = 0; line < count(); ++line) {
      int from = 0;
      for (const Run& run : at(line)) {
        if (run.from > from) gaps.at(line).push_back({from, run.from});
        from = run.to;
      }
      if (from < places_) gaps.at(line).push_back({from, places_});
    }
    return gaps;
  }

  [[nodiscard]] int count() const { return static_cast<int>(runs_.size()); }
  [[nodiscard]] int places() const { return places_; }
  [[nodiscard]] std::vector<Run>& at(int line) { return runs_[static_cast<std::size_t>(line)]; }
  [[nodiscard]] const std::vector<Run>& at(int line) const {
    return runs_[static_cast<std::size_t>(line)];
  }

 private:
  std::vector<std::vector<Run>> runs_;
  int places_;
};

// Sets of connected runs. Each set is named by its first run; runs are numbered line by line. If
// `corners`, runs that touch in a corner are connected too.
class ConnectedRuns {
 public:
  ConnectedRuns(const Lines& lines, bool corners) {
    const int reach = corners ? 1 : 0;
    for (int line = 0; line < lines.count(); ++line) {
      first_.push_back(size_);
      for (std::size_t r = 0; r < lines.at(line).size(); ++r) sets_.add();
      size_ += lines.at(line).size();
      if (line > 0) join(lines.at(line - 1), lines.at(line), reach);
    }
  }

  [[nodiscard]] std::size_t first(int line) const { return first_[static_cast<std::size_t>(line)]; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t root(std::size_t run) { return sets_.root(run); }

 private:
  void join(const std::vector<Run>& before, const std::vector<Run>& now, int reach) {
    const std::size_t first_before = first_[first_.size() - 2];
    const std::size_t first_now = first_.back();
    for (std::size_t x = 0, y = 0; x < before.size() && y < now.size();) {
      const bool touch = before[x].from < now[y].to + reach && now[y].from < before[x].to + reach;
      if (touch) sets_.join(first_before + x, first_now + y);
      before[x].to < now[y].to ? ++x : ++y;
    }
  }

  std::vector<std::size_t> first_;  // number of the first run of each line
  std::size_t size_ = 0;
  DisjointSets sets_;
};

// Joins equal runs on consecutive lines to rectangles. Calls take(rectangle) for each.
template <class Take>
void each_rectangle(const Lines& lines, const Take& take) {
  struct Open {
    Run run;
    int since;
  };
  std::vector<Open> open, now;
  const std::vector<Run> none;
  for (int line = 0; line <= lines.count(); ++line) {
    now.clear();
    const std::vector<Run>& runs = line < lines.count() ? lines.at(line) : none;
    for (const Run& run : runs) now.push_back({run, line});
    auto next = now.begin();
    for (const Open& before : open) {
      while (next != now.end() && next->run.from < before.run.from) ++next;
      const bool goes_on =
          next != now.end() && next->run.from == before.run.from && next->run.to == before.run.to;
      if (goes_on) {
        next->since = before.since;
      } else {
        take(Span{before.since, line, before.run.from, before.run.to});
      }
    }
    std::swap(open, now);
  }
}

}  // namespace armloom
