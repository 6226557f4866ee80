#include "test/scheduler/random_graphs.h"

#include <algorithm>

#include "test/scheduler/bench_cell.h"

namespace armloom {

void RandomGraph::change() {
  switch (random_() % 8) {
    case 0:
    case 1:
    case 2:
      admit();
      break;
    case 3:
    case 4:
    case 5:
      extend_authority();
      check();
      move_arms();
      finish();
      break;
    case 6:
      abandon();
      break;
    default:
      decide_again();
  }
  check();
}

// No place is on an edge of a crossing.
std::vector<Crossing> RandomGraph::table() {
  std::vector<Crossing> table;
  const auto edge = [this] { return 0.105 + 0.05 * static_cast<double>(random_() % 14); };
  const auto size = [this] { return 0.05 + 0.05 * static_cast<double>(random_() % 4); };
  for (auto n = 2 + random_() % 3; n > 0; --n) {
    const auto first = static_cast<std::uint32_t>(random_() % 2);
    const ArmId a{first}, b{first + 1 + static_cast<std::uint32_t>(random_() % (2 - first))};
    const double from_a = edge(), from_b = edge();
    table.push_back({a, from_a, from_a + size(), b, from_b, from_b + size()});
  }
  return table;
}

Duration RandomGraph::between(Duration from, Duration to) {
  const std::uint64_t way = static_cast<std::uint64_t>((to - from).count()) + 1;
  return from + Duration(static_cast<Duration::rep>(random_() % way));
}

// ---- Admission ----

void RandomGraph::admit() {
  std::vector<CoordinatedMotion> all = graph_.motions();
  const std::size_t admitted = all.size();
  for (auto n = 1 + random_() % 3; n > 0; --n) {
    if (auto motion = draw(all)) all.push_back(std::move(*motion));
  }
  const std::vector<CoordinatedMotion> candidates(
      all.begin() + static_cast<std::ptrdiff_t>(admitted), all.end());
  if (candidates.empty()) return;
  Question question{.version = 0,
                    .start_at = {},
                    .candidates = {},
                    .others = {},
                    .rest = rest_,
                    .method = Coordinated{0.0}};
  for (const CoordinatedMotion& motion : all) {
    (graph_.holds(motion.step) ? question.others : question.candidates)
        .push_back(in_question(motion, all));
  }
  const Verdict verdict = crossings_.answer(question);
  if (verdict.kind != Verdict::Kind::free) return;  // a team that meets itself
  const PassingOrders orders = cheapest_orders(graph_.question(candidates, verdict.regions));
  if (!orders.blockers.empty()) return;
  graph_.admit(candidates, orders);
}

// Returns a motion that begins where its arms are after the motions before it; nullopt if one of
// its arms has three motions already.
std::optional<CoordinatedMotion> RandomGraph::draw(const std::vector<CoordinatedMotion>& before) {
  std::vector<std::uint32_t> arms{static_cast<std::uint32_t>(random_() % kArms)};
  if (random_() % 4 == 0) arms.push_back((arms.front() + 1) % kArms);
  std::ranges::sort(arms);
  std::vector<double> from, to;
  for (const std::uint32_t arm : arms) {
    const auto moves = [&](const CoordinatedMotion& motion) { return motion.moves(ArmId{arm}); };
    if (std::ranges::count_if(before, moves) == 3) return std::nullopt;
    from.push_back(end_of(ArmId{arm}, before));
    to.push_back(place());
  }
  const TrajectoryPtr trajectory = move(arms, from, to, between(500ms, 5s));
  const StepId step{JobId{next_job_++}};
  trajectories_[step] = trajectory;
  return CoordinatedMotion{.step = step,
                           .arms = trajectory->arms(),
                           .duration = trajectory->duration(),
                           .horizon = 1500ms};
}

double RandomGraph::end_of(ArmId arm, const std::vector<CoordinatedMotion>& motions) const {
  double end = rest_[static_cast<Eigen::Index>(arm.index())];
  for (const CoordinatedMotion& motion : motions) {
    if (motion.moves(arm)) end = place_of(*trajectories_.at(motion.step), arm, motion.duration);
  }
  return end;
}

Motion RandomGraph::in_question(const CoordinatedMotion& motion,
                                const std::vector<CoordinatedMotion>& all) const {
  const auto is_it = [&](const CoordinatedMotion& one) { return one.step == motion.step; };
  const bool to_come =
      std::any_of(all.begin(), std::ranges::find_if(all, is_it),
                  [&](const CoordinatedMotion& one) { return share_an_arm(one, motion); });
  return {.step = motion.step,
          .trajectory = trajectories_.at(motion.step),
          .progress = motion.progress,
          .to_come = to_come};
}

// Some motions have stood for long, so that others may pass them first.
void RandomGraph::decide_again() {
  for (const CoordinatedMotion& motion : graph_.motions()) {
    Outlook outlook;
    if (random_() % 4 == 0) outlook.stands_for = between(1s, 20s);
    graph_.set_outlook(motion.step, outlook);
  }
  const std::vector<CoordinatedMotion> nobody;
  const std::vector<PairRegions> nothing;
  const PassingOrders orders = cheapest_orders(graph_.question(nobody, nothing));
  if (!orders.blockers.empty() || !orders.prediction.stuck.empty()) return;
  const std::vector<Precedence> before = graph_.precedences();
  graph_.admit(nobody, orders);
  const bool is_reversed = std::ranges::any_of(before, [&](const Precedence& old) {
    return std::ranges::any_of(graph_.precedences(), [&](const Precedence& order) {
      return order.first() == old.second() && order.second() == old.first();
    });
  });
  if (is_reversed) ++count_.reversed;
}

// ---- Movement ----

void RandomGraph::extend_authority() {
  for (const CoordinatedMotion& motion : graph_.motions()) {
    const Duration limit = graph_.limit(motion.step);
    const Duration authority = std::min(limit, motion.progress + motion.horizon);
    if (authority > motion.authority) graph_.granted(motion.step, authority);
  }
}

void RandomGraph::move_arms() {
  for (const CoordinatedMotion& motion : graph_.motions()) {
    const auto habit = random_() % 4;
    if (habit == 0) continue;  // late
    const Duration to = habit == 1 ? between(motion.progress, motion.authority) : motion.authority;
    graph_.progress(motion.step, to);
  }
}

// Ends most of the motions that are at their goals; the end of the others is reported later.
void RandomGraph::finish() {
  const std::vector<CoordinatedMotion> motions = graph_.motions();
  for (const CoordinatedMotion& motion : motions) {
    if (motion.progress < motion.duration || random_() % 3 == 0) continue;
    rest_at(motion, motion.duration);
    graph_.finish(motion.step);
    ++count_.finished;
  }
}

// Abandons a motion and, before it, all motions that follow it on its arms. Its arms come to rest
// within its authority.
void RandomGraph::abandon() {
  const std::vector<CoordinatedMotion> motions = graph_.motions();
  if (motions.empty()) return;
  const std::size_t first = random_() % motions.size();
  std::vector<CoordinatedMotion> ending{motions[first]};
  for (std::size_t next = first + 1; next < motions.size(); ++next) {
    const auto shares = [&](const CoordinatedMotion& one) {
      return share_an_arm(one, motions[next]);
    };
    if (std::ranges::any_of(ending, shares)) ending.push_back(motions[next]);
  }
  for (auto motion = ending.rbegin(); motion != ending.rend(); ++motion) {
    const Duration rests_at = between(motion->progress, motion->authority);
    if (rests_at > Duration{}) {
      rest_at(*motion, rests_at);
      ++count_.abandoned;
    }
    graph_.progress(motion->step, rests_at);
    graph_.abandon(motion->step, rests_at);
  }
}

void RandomGraph::rest_at(const CoordinatedMotion& motion, Duration progress) {
  for (const ArmId arm : motion.arms) {
    rest_[static_cast<Eigen::Index>(arm.index())] =
        place_of(*trajectories_.at(motion.step), arm, progress);
  }
}

// ---- Checks ----

void RandomGraph::check() {
  for (std::uint32_t a = 0; a < kArms; ++a) {
    for (std::uint32_t b = a + 1; b < kArms; ++b) {
      const auto is_team = [&](const CoordinatedMotion& motion) {
        return motion.moves(ArmId{a}) && motion.moves(ArmId{b}) && motion.authority > Duration{};
      };
      if (std::ranges::any_of(graph_.motions(), is_team)) continue;  // its arms move in step
      EXPECT_FALSE(crossings_.meet(ArmId{a}, reach(ArmId{a}), ArmId{b}, reach(ArmId{b})))
          << "arms " << a << " and " << b << " may meet";
    }
  }
  EXPECT_TRUE(graph_.is_acyclic());
  for (const CoordinatedMotion& motion : graph_.motions()) {
    const Duration limit = graph_.limit(motion.step);
    if (limit == Duration{} || limit == motion.duration) continue;
    EXPECT_TRUE(graph_.held_back(motion.step)) << "job " << motion.step.job.value();
    if (motion.progress == limit) ++count_.held;
  }
}

// Returns where the arm may be.
Stretch RandomGraph::reach(ArmId arm) const {
  for (const CoordinatedMotion& motion : graph_.motions()) {
    if (!motion.moves(arm)) continue;
    const Trajectory& trajectory = *trajectories_.at(motion.step);
    const double here = place_of(trajectory, arm, motion.progress),
                 there = place_of(trajectory, arm, motion.authority);
    return {std::min(here, there), std::max(here, there)};
  }
  const double here = rest_[static_cast<Eigen::Index>(arm.index())];
  return {here, here};
}

}  // namespace armloom
