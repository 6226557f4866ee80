// Chooses orders that let a motion start by the clock.
#include <algorithm>
#include <utility>

#include "core/precedence/open_orders.h"

namespace armloom {
namespace {

// The candidate's progress by the clock. It passes second if it reaches each box after the other
// motion has left it, and first if it leaves each box before the other one enters. So each order
// has a latest start for first and an earliest start for second, read from the boxes once.
class Line {
 public:
  Line(const OpenOrders& open, const Prediction& before) : open_(open) {
    for (std::size_t d = 0; d < open_.orders().size(); ++d) {
      windows_.push_back(d < open_.decided() ? Window{} : window_of(d, before));
    }
    join_closed();
    std::ranges::sort(starts_);
    starts_.erase(std::ranges::unique(starts_).begin(), starts_.end());
  }

  // Returns the starts to try, ascending: now, and whenever the other motion leaves a box.
  [[nodiscard]] const std::vector<Duration>& starts() const { return starts_; }

  // Returns false if no side is free in some region when the candidate begins then.
  [[nodiscard]] bool may_start(Duration start) const {
    const auto behind = std::ranges::lower_bound(closed_, start, {}, &Closed::after);
    return behind == closed_.begin() || (behind - 1)->before <= start;
  }

  // Returns true if the candidate passes first with this start, false if second; nullopt if
  // neither.
  [[nodiscard]] std::optional<bool> passes_first(std::size_t order, Duration start) const {
    const Window& window = windows_[order];
    if (start <= window.first_until) return true;
    return start >= window.second_from ? std::optional(false) : std::nullopt;
  }

  [[nodiscard]] bool candidate_is_a(std::size_t order) const {
    return open_.orders()[order].a >= open_.first_candidate();
  }

 private:
  struct Window {
    Duration first_until = Duration::max();
    Duration second_from = Duration::min();
  };

  Window window_of(std::size_t order, const Prediction& before) {
    const OpenOrder& seen = open_.orders()[order];
    const bool own_is_a = candidate_is_a(order);
    const std::size_t other = own_is_a ? seen.b : seen.a;
    const double pace = open_.motions()[own_is_a ? seen.a : seen.b].outlook.pace;
    Window window;
    for (const ProgressBox& of_pair : seen.region.boxes) {
      const ProgressBox box = own_is_a ? of_pair : turned_around(of_pair);
      const Duration own_from = paced(box.from_a, pace), own_to = paced(box.to_a, pace);
      const auto comes = before.goes_beyond(other, box.from_b);
      const auto leaves = before.comes_to(other, box.to_b);
      if (comes) window.first_until = std::min(window.first_until, *comes - own_to);
      window.second_from =
          leaves ? std::max(window.second_from, *leaves - own_from) : Duration::max();
      if (leaves && *leaves > own_from) starts_.push_back(*leaves - own_from);
    }
    return window;
  }

  struct Closed {  // both ends are open
    Duration after, before;
  };
  void join_closed() {
    std::vector<Closed> all;
    for (const Window& window : windows_) {
      if (window.first_until < window.second_from) {
        all.push_back({window.first_until, window.second_from});
      }
    }
    std::ranges::sort(all, {}, &Closed::after);
    for (const Closed& next : all) {
      if (!closed_.empty() && next.after < closed_.back().before) {
        closed_.back().before = std::max(closed_.back().before, next.before);
      } else {
        closed_.push_back(next);
      }
    }
  }

  const OpenOrders& open_;
  std::vector<Window> windows_;  // by order
  std::vector<Closed> closed_;   // ascending
  std::vector<Duration> starts_{Duration{}};
};

// Sets the candidate's orders as it passes, and keeps the decided ones. Returns the orders with no
// possible or no permitted side.
std::vector<std::size_t> set_by_line(OpenOrders& open, const Line& line, Duration start) {
  std::vector<std::size_t> in_the_way;
  for (OrderChoice& choice : open.choices()) {
    std::optional<bool> value;
    for (const OrderChoice::Member& member : choice.members) {
      const bool of_before = member.order < open.decided();
      const auto first = of_before ? std::optional(true) : line.passes_first(member.order, start);
      const bool a_first = of_before || (first && *first == line.candidate_is_a(member.order));
      const bool side = a_first != member.turned;
      const bool allowed = first && std::ranges::find(choice.options, side) != choice.options.end();
      if (!allowed || (value && *value != side)) {
        if (!of_before) in_the_way.push_back(member.order);
        value.reset();
        break;
      }
      value = side;
    }
    if (value) open.set(choice, *value, true);
  }
  return in_the_way;
}

}  // namespace

PassingOrders orders_in_time(const OrderQuestion& question, std::optional<Duration> latest) {
  OpenOrders open(question);
  if (open.blocked()) return open.refused({});
  const Line line(open, open.predicted_before());
  std::vector<std::size_t> in_the_way;
  for (const Duration start : line.starts()) {
    if (latest && start > *latest) break;
    if (!in_the_way.empty() && !line.may_start(start)) continue;
    auto against = set_by_line(open, line, start);
    if (against.empty()) {
      Prediction prediction = open.predicted();
      if (prediction.stuck.empty()) return open.admitted(std::move(prediction));
    } else if (in_the_way.empty()) {
      in_the_way = std::move(against);
    }
  }
  if (in_the_way.empty()) return open.stuck(open.predicted());
  return open.refused(in_the_way);
}

}  // namespace armloom
