#include "test/scheduler/crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace armloom {
namespace {

constexpr double kTouch = 1e-6;  // rad

bool moves(const Motion& motion, ArmId arm) {
  const auto& arms = motion.trajectory->arms();
  return std::ranges::find(arms, arm) != arms.end();
}

bool share_an_arm(const Motion& a, const Motion& b) {
  return std::ranges::any_of(a.trajectory->arms(), [&](ArmId arm) { return moves(b, arm); });
}

bool touch(const ProgressBox& x, const ProgressBox& y) {
  return x.from_a <= y.to_a && y.from_a <= x.to_a && x.from_b <= y.to_b && y.from_b <= x.to_b;
}

Proximity proximity_of(ArmId a, ArmId b) {
  return {.body_a = "a", .body_b = "b", .arm_a = a, .arm_b = b, .clearance_m = 0.0};
}

}  // namespace

bool Crossings::meet(ArmId a, Stretch of_a, ArmId b, Stretch of_b) const {
  if (b < a) return meet(b, of_b, a, of_a);
  return std::ranges::any_of(table_, [&](const Crossing& c) {
    return c.a == a && c.b == b && of_a.from < c.to_a - kTouch && of_a.to > c.from_a + kTouch &&
           of_b.from < c.to_b - kTouch && of_b.to > c.from_b + kTouch;
  });
}

// Joins connected boxes to regions. A region has the evidence of one of its boxes.
std::vector<ConflictRegion> Crossings::regions_of(std::vector<Box> boxes) {
  std::vector<ConflictRegion> regions;
  while (!boxes.empty()) {
    const Box first = boxes.back();
    boxes.pop_back();
    std::vector<ProgressBox> region{first};
    for (std::size_t i = 0; i < region.size(); ++i) {  // `region` grows meanwhile
      for (std::size_t b = boxes.size(); b-- > 0;) {
        if (!touch(region[i], boxes[b])) continue;
        region.push_back(boxes[b]);
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(b));
      }
    }
    regions.push_back(
        {std::move(region), proximity_of(first.a, first.b), first.from_a, first.from_b});
  }
  return regions;
}

std::vector<Crossings::Box> Crossings::boxes(const Motion& a, const Motion& b) const {
  std::vector<Box> boxes;
  const auto add = [&](ArmId arm_a, Stretch of_a, ArmId arm_b, Stretch of_b) {
    if (!moves(a, arm_a) || !moves(b, arm_b)) return;
    for (const Span& span_a : spans_in(*a.trajectory, arm_a, of_a)) {
      for (const Span& span_b : spans_in(*b.trajectory, arm_b, of_b)) {
        if (span_a.to < a.progress || span_b.to < b.progress) continue;
        boxes.push_back({{span_a.from, span_a.to, span_b.from, span_b.to}, arm_a, arm_b});
      }
    }
  };
  for (const Crossing& c : table_) {
    add(c.a, {c.from_a, c.to_a}, c.b, {c.from_b, c.to_b});
    add(c.b, {c.from_b, c.to_b}, c.a, {c.from_a, c.to_a});
  }
  return boxes;
}

std::vector<Crossings::Box> Crossings::boxes(const Motion& a, Standing b) const {
  std::vector<Box> boxes;
  const auto add = [&](ArmId arm_a, Stretch of_a, ArmId arm_b, Stretch of_b) {
    if (!moves(a, arm_a) || arm_b != b.arm || b.q <= of_b.from || b.q >= of_b.to) return;
    for (const Span& span : spans_in(*a.trajectory, arm_a, of_a)) {
      if (span.to >= a.progress) boxes.push_back({{span.from, span.to, {}, {}}, arm_a, arm_b});
    }
  };
  for (const Crossing& c : table_) {
    add(c.a, {c.from_a, c.to_a}, c.b, {c.from_b, c.to_b});
    add(c.b, {c.from_b, c.to_b}, c.a, {c.from_a, c.to_a});
  }
  return boxes;
}

bool Crossings::meets_object(const Motion& motion) const {
  return std::ranges::any_of(objects_, [&](const Object& object) {
    if (!moves(motion, object.arm)) return false;
    const auto spans = spans_in(*motion.trajectory, object.arm, {object.from, object.to});
    return std::ranges::any_of(spans, [&](const Span& s) { return s.to >= motion.progress; });
  });
}

// The motion's arms always move in step.
bool Crossings::meets_itself(const Motion& motion) const {
  return std::ranges::any_of(boxes(motion, motion), [](const Box& box) {
    return box.from_a <= box.to_b && box.from_b <= box.to_a;
  });
}

bool Crossings::free_beside(const Trajectory& motion, const Configuration& rest) const {
  const Motion alone{StepId{JobId{0}}, TrajectoryPtr(TrajectoryPtr{}, &motion), Duration{}};
  if (meets_object(alone) || meets_itself(alone)) return false;
  for (Eigen::Index joint = 0; joint < rest.size(); ++joint) {
    const ArmId arm{static_cast<std::uint32_t>(joint)};
    if (!moves(alone, arm) && !boxes(alone, Standing{arm, rest[joint]}).empty()) return false;
  }
  return true;
}

// ---- Answers ----

// Returns the arms that rest while the candidate moves, and where they rest. If the motion of such
// an arm directly before or after the candidate shares an arm with it, the arm rests at the end or
// the start of that motion.
std::vector<Crossings::Standing> Crossings::standing_beside(const Question& question,
                                                            const Motion& candidate) const {
  std::vector<const Motion*> in_order;
  for (const Motion& motion : question.others) in_order.push_back(&motion);
  for (const Motion& motion : question.candidates) in_order.push_back(&motion);
  std::ranges::stable_partition(in_order, [](const Motion* motion) { return !motion->to_come; });
  const auto own = std::ranges::find(in_order, &candidate);
  std::vector<Standing> standing;
  for (Eigen::Index joint = 0; joint < question.rest.size(); ++joint) {
    const ArmId arm{static_cast<std::uint32_t>(joint)};
    if (moves(candidate, arm)) continue;
    const Motion* before = nullptr;
    const Motion* behind = nullptr;
    for (auto motion = in_order.begin(); motion != in_order.end(); ++motion) {
      if (!moves(**motion, arm)) continue;
      if (motion < own) before = *motion;
      if (motion > own && behind == nullptr) behind = *motion;
    }
    if (before != nullptr && !share_an_arm(candidate, *before)) continue;
    if (behind != nullptr && !share_an_arm(candidate, *behind)) continue;
    double q = question.rest[joint];
    if (before != nullptr) {
      q = place_of(*before->trajectory, arm, before->trajectory->duration());
    } else if (behind != nullptr) {
      q = place_of(*behind->trajectory, arm, Duration{});
    }
    standing.push_back({arm, q});
  }
  return standing;
}

void Crossings::coordinate(const Question& question, Verdict& verdict) const {
  const auto compare = [&](const Motion& a, const Motion& b) {
    if (share_an_arm(a, b)) return;
    auto found = boxes(a, b);
    if (found.empty()) return;
    verdict.regions.push_back({a.step, b.step, regions_of(std::move(found))});
  };
  for (auto own = question.candidates.begin(); own != question.candidates.end(); ++own) {
    for (const Motion& other : question.others) compare(*own, other);
    for (auto other = own + 1; other != question.candidates.end(); ++other) compare(*own, *other);
    for (const Standing& standing : standing_beside(question, *own)) {
      auto found = boxes(*own, standing);
      if (found.empty()) continue;
      verdict.regions.push_back({own->step, standing.arm, regions_of(std::move(found))});
    }
  }
}

void Crossings::compare_sweeps(const Question& question, Verdict& verdict) const {
  for (const Motion& own : question.candidates) {
    for (const Motion& other : question.others) {
      const auto found = boxes(own, other);
      if (found.empty()) continue;
      const auto near = proximity_of(found.front().a, found.front().b);
      verdict.conflicts.push_back({Conflict::With::motion, own.step, other.step, near,
                                   found.front().from_a, found.front().from_b});
    }
    for (const Standing& standing : standing_beside(question, own)) {
      const auto found = boxes(own, standing);
      if (found.empty()) continue;
      const auto near = proximity_of(found.front().a, standing.arm);
      verdict.conflicts.push_back(
          {Conflict::With::rest, own.step, {}, near, found.front().from_a, {}});
    }
  }
}

void Crossings::compare_instants(const Question& question, Duration step, Verdict& verdict) const {
  const auto met_at = [&](const Motion& own, Duration t, auto&& place_of_other, ArmId arm) {
    return std::ranges::any_of(own.trajectory->arms(), [&](ArmId moved) {
      const double q = place_of(*own.trajectory, moved, own.progress + t);
      const double other = place_of_other(t);
      return meet(moved, {q, q}, arm, {other, other});
    });
  };
  for (const Motion& own : question.candidates) {
    const auto compare = [&](ArmId arm, Duration until, std::optional<StepId> of, auto&& where) {
      for (Duration t{}; t < until + step; t += step) {
        if (!met_at(own, t, where, arm)) continue;
        verdict.conflicts.push_back({of ? Conflict::With::motion : Conflict::With::rest, own.step,
                                     of, proximity_of(own.trajectory->arms().front(), arm), t, t});
        return;
      }
    };
    for (const Motion& other : question.others) {
      for (const ArmId arm : other.trajectory->arms()) {
        compare(arm, std::max(own.remaining(), other.remaining()), other.step,
                [&](Duration t) { return place_of(*other.trajectory, arm, other.progress + t); });
      }
    }
    for (const Standing& standing : standing_beside(question, own)) {
      compare(standing.arm, own.remaining(), {}, [&](Duration) { return standing.q; });
    }
  }
}

PassageAnswer Crossings::answer(const PassageQuestion& passage) const {
  const bool apart = std::ranges::none_of(table_, [&](const Crossing& c) {
    return (moves(passage.motion, c.a) && c.b == passage.arm) ||
           (moves(passage.motion, c.b) && c.a == passage.arm);
  });
  if (apart) return PassageAnswer::apart;
  return boxes(passage.motion, Standing{passage.arm, passage.rest[0]}).empty()
             ? PassageAnswer::free
             : PassageAnswer::blocked;
}

Verdict Crossings::answer(const Question& question) const {
  Verdict verdict{Verdict::Kind::free, question.version, {}, {}, 1};
  for (const PassageQuestion& passage : question.passages) {
    verdict.passages.push_back(answer(passage));
    std::optional<PassageBlock>& block = verdict.passage_blocks.emplace_back();
    if (verdict.passages.back() != PassageAnswer::blocked) continue;
    block =
        PassageBlock{proximity_of(passage.motion.trajectory->arms().front(), passage.arm),
                     boxes(passage.motion, Standing{passage.arm, passage.rest[0]}).front().from_a};
  }
  for (const Motion& own : question.candidates) {
    const auto near = proximity_of(own.trajectory->arms().front(), ArmId{0});
    if (meets_object(own)) {
      verdict.conflicts.push_back({Conflict::With::scene, own.step, {}, near, {}, {}});
    }
    if (meets_itself(own)) {
      verdict.conflicts.push_back({Conflict::With::self, own.step, {}, near, {}, {}});
    }
  }
  if (std::holds_alternative<Coordinated>(question.method)) {
    if (verdict.conflicts.empty()) coordinate(question, verdict);
  } else if (const auto* timed = std::get_if<TimedDiscrete>(&question.method)) {
    compare_instants(question, timed->step, verdict);
  } else {
    compare_sweeps(question, verdict);
  }
  if (!verdict.conflicts.empty()) verdict.kind = Verdict::Kind::conflict;
  return verdict;
}

}  // namespace armloom
