#include "core/precedence/precedence_graph.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace armloom {

const CoordinatedMotion* PrecedenceGraph::find(StepId step) const {
  const auto found = std::ranges::find(motions_, step, &CoordinatedMotion::step);
  return found == motions_.end() ? nullptr : &*found;
}

std::size_t PrecedenceGraph::index_of(StepId step) const {
  return static_cast<std::size_t>(find(step) - motions_.data());
}

void PrecedenceGraph::admit(const std::vector<CoordinatedMotion>& candidates,
                            const PassingOrders& orders) {
  motions_.insert(motions_.end(), candidates.begin(), candidates.end());
  // A candidate that takes an arm away has regions of its own for what the arm blocks.
  for (Rest& rest : rests_) {
    const std::size_t held = index_of(rest.order.second());
    rest.arms = resting_for(motions_, rest.arms, held, held);
  }
  std::erase_if(rests_, [](const Rest& rest) { return rest.arms.empty(); });
  precedences_ = orders.precedences;
  std::erase_if(precedences_, [this](const Precedence& precedence) {
    return find(precedence.first())->is_beyond(precedence.steps().back().until);
  });
}

void PrecedenceGraph::progress(StepId step, Duration progress) {
  if (!holds(step)) return;
  CoordinatedMotion& motion = motions_[index_of(step)];
  motion.progress = std::max(motion.progress, progress);
  motion.authority = std::max(motion.authority, motion.progress);
}

Duration PrecedenceGraph::limit(StepId step) const {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return Duration{};
  const auto index = static_cast<std::size_t>(found - motions_.data());
  const bool waits_for_own_arm = std::ranges::any_of(
      found->arms, [&](ArmId arm) { return motion_before(motions_, index, arm).has_value(); });
  if (waits_for_own_arm) return Duration{};
  Duration limit = found->duration;
  for (const Rest& rest : rests_) {
    if (rest.order.second() == step && is_ahead(rest)) limit = std::min(limit, rest.limit());
  }
  for (const Precedence& precedence : precedences_) {
    if (precedence.second() != step) continue;
    const auto held = limit_by(precedence);
    if (held) limit = std::min(limit, *held);
  }
  return limit;
}

// Returns the largest authority that the second motion may have; nullopt if there is no limit.
// While the first motion is on its way to a goal, that goal does not limit more than the order.
std::optional<Duration> PrecedenceGraph::limit_by(const Precedence& order) const {
  auto limit = order.limit(find(order.first())->progress);
  if (limit) return limit;
  if (const auto goal = goal_in(order)) limit = goal->limit();
  return limit;
}

std::optional<Blocker> PrecedenceGraph::held_back(StepId step) const {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return std::nullopt;
  const Duration at = limit(step);
  if (at >= found->duration) return std::nullopt;
  const auto rest = rests_ahead(step);
  if (rest && rest->limit() == at) return rest->blocker();
  for (const Precedence& precedence : precedences_) {
    if (precedence.second() != step) continue;
    if (precedence.limit(find(precedence.first())->progress) != at) continue;
    return blocker_of(precedence);
  }
  return std::nullopt;
}

std::optional<PrecedenceGraph::Rest> PrecedenceGraph::rests_ahead(StepId step) const {
  std::vector<Rest> rests = rests_before(step);
  const auto nearest = std::ranges::min_element(rests, {}, &Rest::limit);
  return nearest != rests.end() ? std::optional(std::move(*nearest)) : std::nullopt;
}

HeldAt PrecedenceGraph::held_at() const {
  HeldAt held_at(motions_.size());
  for (const Rest& rest : rests_before(std::nullopt)) {
    auto& held = held_at[index_of(rest.order.second())];
    held = std::min(held.value_or(rest.limit()), rest.limit());
  }
  return held_at;
}

std::vector<Dependency> PrecedenceGraph::dependencies() const {
  std::vector<Dependency> dependencies;
  for (const Precedence& precedence : precedences_) {
    dependencies.push_back(
        {index_of(precedence.first()), index_of(precedence.second()), &precedence});
  }
  return dependencies;
}

bool PrecedenceGraph::is_held_by(StepId step, const std::vector<ArmId>& arms) const {
  return std::ranges::any_of(rests_before(step), [&](const Rest& rest) {
    return std::ranges::find_first_of(rest.arms, arms) != rest.arms.end();
  });
}

bool PrecedenceGraph::is_acyclic() const {
  return predict(motions_, MotionChains(motions_), dependencies()).stuck.empty();
}

void PrecedenceGraph::granted(StepId step, Duration authority) {
  if (!holds(step)) return;
  if (authority > limit(step)) {
    throw std::logic_error("job " + std::to_string(step.job.value()) +
                           ": authority beyond its limit");
  }
  CoordinatedMotion& motion = motions_[index_of(step)];
  motion.authority = std::max(motion.authority, authority);
}

void PrecedenceGraph::set_outlook(StepId step, const Outlook& outlook) {
  motions_[index_of(step)].outlook = outlook;
}

void PrecedenceGraph::set_priority(StepId step, int priority) {
  motions_[index_of(step)].priority = priority;
}

void PrecedenceGraph::finish(StepId step) {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return;
  come_to_rest(step, found->arms, found->duration, found->duration);
  erase(step);
}

void PrecedenceGraph::abandon(StepId step, Duration rests_at, Duration farthest) {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return;
  std::map<std::optional<std::size_t>, std::vector<ArmId>> brought_by;
  for (const ArmId arm : found->arms) {
    brought_by[motion_before(motions_, index_of(step), arm)].push_back(arm);
  }
  for (const auto& [before, arms] : brought_by) {
    if (before) {
      come_to_rest(step, arms, Duration{}, Duration{}, before);
    } else {
      come_to_rest(step, arms, rests_at, std::max(rests_at, farthest));
    }
  }
  erase(step);
}

// If the motion `brought_by` brings the arms there, only motions that share an arm with it are
// handled, because they have no regions with it. For all others its goal has the same effect.
void PrecedenceGraph::come_to_rest(StepId step, const std::vector<ArmId>& arms, Duration at,
                                   Duration farthest, std::optional<std::size_t> brought_by) {
  for (const Precedence& order : precedences_) {
    const bool first = order.first() == step;
    if (!first && (order.second() != step || brought_by)) continue;
    const bool is_told = brought_by && !share_an_arm(motions_[*brought_by], *find(order.second()));
    if (is_told) continue;
    if (auto rest = rest_in(order, step, arms, at, farthest)) rests_.push_back(std::move(*rest));
  }
}

// Returns the rest of these arms on the motion `resting`, one of the two that have the order;
// nullopt if the other one has passed it, does not meet it, or waits until it is left.
std::optional<PrecedenceGraph::Rest> PrecedenceGraph::rest_in(const Precedence& order,
                                                              StepId resting,
                                                              const std::vector<ArmId>& arms,
                                                              Duration at,
                                                              Duration farthest) const {
  const bool first = order.first() == resting;
  const std::size_t own = index_of(resting),
                    other = index_of(first ? order.second() : order.first());
  std::vector<ArmId> staying = resting_for(motions_, arms, own, other);
  if (staying.empty()) return std::nullopt;
  ConflictRegion region = Precedence(order.first(), order.second(), order.region(), first).region();
  std::erase_if(region.boxes, [&](const ProgressBox& box) {
    const bool is_left = box.to_a <= at && box.to_a < motions_[own].duration;
    return is_left || farthest < box.from_a || box.to_b <= motions_[other].progress;
  });
  if (region.boxes.empty()) return std::nullopt;
  for (ProgressBox& box : region.boxes) box.to_a = Duration::max();
  return Rest{std::move(staying), Precedence(resting, motions_[other].step, region, true)};
}

// Returns the rest of the first motion's arms at its end, now or later; nullopt as rest_in().
std::optional<PrecedenceGraph::Rest> PrecedenceGraph::goal_in(const Precedence& order) const {
  const CoordinatedMotion& first = *find(order.first());
  if (order.steps().back().until < first.duration) return std::nullopt;
  return rest_in(order, first.step, first.arms, first.duration, first.duration);
}

// Returns true if the second motion has not passed the rest.
bool PrecedenceGraph::is_ahead(const Rest& rest) const {
  const Duration passed = find(rest.order.second())->progress;
  return std::ranges::any_of(rest.order.region().boxes,
                             [&](const ProgressBox& box) { return passed < box.to_b; });
}

// Returns the rests that the motion, or with nullopt any motion, has still to pass: arms that rest
// in its path, and goals where arms will.
std::vector<PrecedenceGraph::Rest> PrecedenceGraph::rests_before(std::optional<StepId> step) const {
  std::vector<Rest> rests;
  for (const Rest& rest : rests_) {
    if ((!step || rest.order.second() == *step) && is_ahead(rest)) rests.push_back(rest);
  }
  for (const Precedence& order : precedences_) {
    if (step && order.second() != *step) continue;
    if (auto goal = goal_in(order)) rests.push_back(std::move(*goal));
  }
  return rests;
}

Blocker PrecedenceGraph::Rest::blocker() const {
  Blocker blocker = blocker_of(order);
  blocker.other.reset();
  const auto named = blocker.proximity.arm_b;
  const bool is_resting = named && std::ranges::find(arms, *named) != arms.end();
  blocker.arm = is_resting ? *named : arms.front();
  return blocker;
}

void PrecedenceGraph::erase(StepId step) {
  std::erase_if(precedences_, [step](const Precedence& precedence) {
    return precedence.first() == step || precedence.second() == step;
  });
  std::erase_if(rests_, [step](const Rest& rest) { return rest.order.second() == step; });
  std::erase_if(motions_, [step](const CoordinatedMotion& motion) { return motion.step == step; });
}

Blocker blocker_of(const Precedence& precedence) {
  const ConflictRegion& region = precedence.region();
  return {precedence.second(), precedence.first(), std::nullopt, turned_around(region.proximity),
          region.time_b,       region.time_a};
}

}  // namespace armloom
