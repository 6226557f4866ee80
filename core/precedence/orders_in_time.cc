// Orders that a start by the clock makes.
#include <algorithm>
#include <utility>

#include "core/precedence/open_orders.h"

namespace armloom {
namespace {

// By its line a motion passes second if it comes to each box after the other one has left it, first
// if it has left each before the other one goes into it.
class Line {
 public:
  Line(const OpenOrders& open, Prediction before) : open_(open), before_(std::move(before)) {}

  // The starts that could be the first one that is possible: now, and as the other one leaves a box
  // of some region. Ascending.
  [[nodiscard]] std::vector<Duration> starts() const {
    std::vector<Duration> starts{Duration{}};
    for (std::size_t d = open_.decided(); d < open_.orders().size(); ++d) {
      const View view = seen_from_candidate(d);
      for (const ProgressBox& box : view.order->region.boxes) {
        const auto leaves = before_.comes_to(view.other, view.other_to(box));
        if (!leaves) continue;
        const Duration start = *leaves - view.own_from(box);
        if (start > Duration{}) starts.push_back(start);
      }
    }
    std::ranges::sort(starts);
    starts.erase(std::ranges::unique(starts).begin(), starts.end());
    return starts;
  }

  // Whether the candidate passes first there when it begins then; nothing: it is neither.
  [[nodiscard]] std::optional<bool> passes_first(std::size_t order, Duration start) const {
    const View view = seen_from_candidate(order);
    bool first = true, second = true;
    for (const ProgressBox& box : view.order->region.boxes) {
      const auto comes = before_.goes_beyond(view.other, view.other_from(box));
      const auto leaves = before_.comes_to(view.other, view.other_to(box));
      if (comes && start + view.own_to(box) > *comes) first = false;
      if (!leaves || start + view.own_from(box) < *leaves) second = false;
    }
    if (first) return true;
    return second ? std::optional(false) : std::nullopt;
  }

  [[nodiscard]] bool candidate_is_a(std::size_t order) const {
    return open_.orders()[order].a >= open_.first_candidate();
  }

 private:
  struct View {
    const OpenOrder* order;
    bool own_is_a;
    std::size_t other;
    [[nodiscard]] Duration own_from(const ProgressBox& b) const {
      return own_is_a ? b.from_a : b.from_b;
    }
    [[nodiscard]] Duration own_to(const ProgressBox& b) const { return own_is_a ? b.to_a : b.to_b; }
    [[nodiscard]] Duration other_from(const ProgressBox& b) const {
      return own_is_a ? b.from_b : b.from_a;
    }
    [[nodiscard]] Duration other_to(const ProgressBox& b) const {
      return own_is_a ? b.to_b : b.to_a;
    }
  };
  [[nodiscard]] View seen_from_candidate(std::size_t order) const {
    const OpenOrder& seen = open_.orders()[order];
    const bool own_is_a = candidate_is_a(order);
    return {&seen, own_is_a, own_is_a ? seen.b : seen.a};
  }

  const OpenOrders& open_;
  Prediction before_;
};

// Sets the candidate's orders as its line passes, and leaves those of before. Returns those that it
// passes on no side, or on one where it may not.
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
