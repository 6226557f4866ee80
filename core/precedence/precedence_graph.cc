#include "core/precedence/precedence_graph.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace armloom {
namespace {

struct Interval {
  Duration from, to;
};

// Whether arms that rest on a motion of this duration, from the first to the last of `at`, are in
// the interval; its closed edges are free, but for the motion's own ends and a seam.
bool rests_in(const Interval& at, const Interval& box, Duration duration, bool seam) {
  const bool after = box.from < at.to || box.from <= Duration{} || seam;
  const bool before = at.from < box.to || box.to >= duration;
  return after && before && box.from <= at.to && at.from <= box.to;
}

// On which arms it comes right after it.
std::vector<ArmId> follows_on(const std::vector<CoordinatedMotion>& motions,
                              const CoordinatedMotion& next, const CoordinatedMotion& before) {
  std::vector<ArmId> arms;
  std::ranges::copy_if(next.arms, std::back_inserter(arms), [&](ArmId arm) {
    const auto takes = [arm](const CoordinatedMotion& motion) {
      return std::ranges::find(motion.arms, arm) != motion.arms.end();
    };
    return takes(before) && std::none_of(motions.begin() + (&before - motions.data()) + 1,
                                         motions.begin() + (&next - motions.data()), takes);
  });
  return arms;
}

}  // namespace

const CoordinatedMotion* PrecedenceGraph::find(StepId step) const {
  const auto found = std::ranges::find(motions_, step, &CoordinatedMotion::step);
  return found == motions_.end() ? nullptr : &*found;
}

CoordinatedMotion* PrecedenceGraph::motion(StepId step) {
  return const_cast<CoordinatedMotion*>(std::as_const(*this).find(step));
}

void PrecedenceGraph::admit(const std::vector<CoordinatedMotion>& candidates,
                            const PassingOrders& orders) {
  for (const CoordinatedMotion& candidate : candidates) {
    // Its regions say from now on what its arms are in the way of; but for motions of its own arms.
    for (Blockade& blockade : blockades_) {
      if (!share_an_arm(*find(blockade.step), candidate)) blockade.leave(candidate.arms);
    }
    std::erase_if(blockades_, [](const Blockade& blockade) { return blockade.arms.empty(); });
    motions_.push_back(candidate);
  }
  precedences_ = orders.precedences;
  std::erase_if(precedences_, [this](const Precedence& precedence) {
    return !precedence.limit(find(precedence.first())->progress);
  });
  renew_held_at();
}

void PrecedenceGraph::progress(StepId step, Duration progress) {
  CoordinatedMotion* found = motion(step);
  if (found == nullptr) return;
  found->progress = std::max(found->progress, progress);
  found->authority = std::max(found->authority, found->progress);
}

void PrecedenceGraph::Blockade::leave(const std::vector<ArmId>& left) {
  std::erase_if(arms, [&](ArmId arm) { return std::ranges::find(left, arm) != left.end(); });
  if (!arms.empty() && std::ranges::find(arms, *evidence.arm) == arms.end()) {
    evidence.arm = arms.front();
  }
}

bool PrecedenceGraph::waits_for_own_arm(std::size_t index) const {
  for (std::size_t i = 0; i < index; ++i) {
    if (share_an_arm(motions_[i], motions_[index])) return true;
  }
  return false;
}

Duration PrecedenceGraph::limit(StepId step) const {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return Duration{};
  if (waits_for_own_arm(static_cast<std::size_t>(found - motions_.data()))) return Duration{};
  Duration limit = found->duration;
  for (const Precedence& precedence : precedences_) {
    if (precedence.second() != step) continue;
    const auto held = precedence.limit(find(precedence.first())->progress);
    if (held) limit = std::min(limit, *held);
  }
  for (const Blockade& blockade : blockades_) {
    if (blockade.step == step && found->progress < blockade.until) {
      limit = std::min(limit, blockade.limit);
    }
  }
  return limit;
}

std::optional<Blocker> PrecedenceGraph::held_back(StepId step) const {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return std::nullopt;
  const Duration at = limit(step);
  if (at >= found->duration) return std::nullopt;
  for (const Blockade& blockade : blockades_) {
    if (blockade.step == step && blockade.limit == at && found->progress < blockade.until) {
      return blockade.evidence;
    }
  }
  for (const Precedence& precedence : precedences_) {
    if (precedence.second() != step) continue;
    if (precedence.limit(find(precedence.first())->progress) != at) continue;
    return blocker_of(precedence);
  }
  return std::nullopt;
}

std::optional<Blocker> PrecedenceGraph::rests_ahead(StepId step) const {
  const CoordinatedMotion* found = find(step);
  const Blockade* blockade = found != nullptr ? nearest_blockade(*found) : nullptr;
  return blockade != nullptr ? std::optional(blockade->evidence) : std::nullopt;
}

std::vector<Dependency> PrecedenceGraph::dependencies() const {
  const auto index = [this](StepId step) {
    return static_cast<std::size_t>(find(step) - motions_.data());
  };
  std::vector<Dependency> dependencies;
  for (const Precedence& precedence : precedences_) {
    dependencies.push_back({index(precedence.first()), index(precedence.second()), &precedence});
  }
  return dependencies;
}

bool PrecedenceGraph::is_held_by(StepId step, const std::vector<ArmId>& arms) const {
  return std::ranges::any_of(blockades_, [&](const Blockade& blockade) {
    return blockade.step == step && std::ranges::any_of(blockade.arms, [&](ArmId arm) {
             return std::ranges::find(arms, arm) != arms.end();
           });
  });
}

bool PrecedenceGraph::is_acyclic() const {
  return predict(motions_, MotionChains(motions_), dependencies()).stuck.empty();
}

void PrecedenceGraph::granted(StepId step, Duration authority) {
  CoordinatedMotion* found = motion(step);
  if (found == nullptr) return;
  if (authority > limit(step)) {
    throw std::logic_error("job " + std::to_string(step.job.value()) +
                           ": authority beyond its limit");
  }
  found->authority = std::max(found->authority, authority);
}

void PrecedenceGraph::set_outlook(StepId step, const Outlook& outlook) {
  motion(step)->outlook = outlook;
}

void PrecedenceGraph::set_priority(StepId step, int priority) { motion(step)->priority = priority; }

void PrecedenceGraph::finish(StepId step) {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return;
  const bool moves_on = std::ranges::any_of(motions_, [&](const CoordinatedMotion& motion) {
    return &motion > found && share_an_arm(motion, *found);
  });
  if (!moves_on) block_others(*found, {found->arms, found->duration, found->duration});
  for (Blockade& blockade : blockades_) {
    if (blockade.goal_of == step) blockade.goal_of.reset();  // there they are
  }
  erase(step);
}

void PrecedenceGraph::abandon(StepId step, Duration rests_at, Duration farthest) {
  const CoordinatedMotion* found = find(step);
  if (found == nullptr) return;
  std::erase_if(blockades_, [step](const Blockade& blockade) { return blockade.goal_of == step; });
  // Who was to pass after it has left the goal of the one before it would wait in vain. Not who
  // passes before that one comes there.
  std::vector<ArmId> stand = found->arms;
  for (const CoordinatedMotion& before : motions_) {
    if (&before == found) break;
    const std::vector<ArmId> arms = follows_on(motions_, *found, before);
    if (arms.empty()) continue;
    std::erase_if(stand, [&](ArmId arm) { return std::ranges::find(arms, arm) != arms.end(); });
    block_others(before, {arms, before.duration, before.duration});
    block_others(*found, {arms, Duration{}, Duration{}, &before});
  }
  if (!stand.empty()) block_others(*found, {stand, rests_at, std::max(rests_at, farthest)});
  erase(step);
}

// Whether it rests there now or will.
void PrecedenceGraph::block_others(const CoordinatedMotion& motion, const Rest& rest) {
  const auto [arms, at, farthest, brought_by] = rest;
  const bool is_there = motion.progress >= at;
  for (const Precedence& precedence : precedences_) {
    const bool first = precedence.first() == motion.step;
    if (!first && (precedence.second() != motion.step || !is_there)) continue;
    const StepId other = first ? precedence.second() : precedence.first();
    if (brought_by != nullptr && !share_an_arm(*brought_by, *find(other))) continue;
    const ConflictRegion& region = precedence.region();
    const Duration passed = find(other)->progress;
    std::vector<ProgressBox> last;  // boxes that end where it rests farthest
    std::ranges::copy_if(region.boxes, std::back_inserter(last), [&](const ProgressBox& box) {
      return (first ? box.to_a : box.to_b) == farthest;
    });
    std::optional<Blockade> blockade;
    for (const ProgressBox& box : region.boxes) {
      const Duration from = first ? box.from_a : box.from_b, to = first ? box.to_a : box.to_b;
      const Duration own_from = first ? box.from_b : box.from_a;
      const Duration own_to = first ? box.to_b : box.to_a;
      // Where another box ends that it is in the way of too, the edge is none of the outline.
      const bool seam = std::ranges::any_of(last, [&](const ProgressBox& other_box) {
        return (first ? other_box.from_b : other_box.from_a) <= own_to &&
               own_from <= (first ? other_box.to_b : other_box.to_a);
      });
      if (own_to <= passed || !rests_in({at, farthest}, {from, to}, motion.duration, seam))
        continue;
      if (!blockade) {
        Blocker evidence{other,
                         std::nullopt,
                         arms.front(),
                         first ? turned_around(region.proximity) : region.proximity,
                         first ? region.time_b : region.time_a,
                         first ? region.time_a : region.time_b};
        const auto named = evidence.proximity.arm_b;
        if (named && std::ranges::find(arms, *named) != arms.end()) evidence.arm = named;
        const CoordinatedMotion* brings = is_there ? brought_by : &motion;
        const auto goal_of = brings != nullptr ? std::optional(brings->step) : std::nullopt;
        blockade = Blockade{arms, goal_of, other, own_from, own_to, evidence};
      }
      blockade->limit = std::min(blockade->limit, std::max(Duration{}, own_from - kShortOf));
      blockade->until = std::max(blockade->until, own_to);
    }
    if (blockade) blockades_.push_back(std::move(*blockade));
  }
}

void PrecedenceGraph::erase(StepId step) {
  std::erase_if(precedences_, [step](const Precedence& precedence) {
    return precedence.first() == step || precedence.second() == step;
  });
  std::erase_if(blockades_, [step](const Blockade& blockade) { return blockade.step == step; });
  std::erase_if(motions_, [step](const CoordinatedMotion& motion) { return motion.step == step; });
  renew_held_at();
}

const PrecedenceGraph::Blockade* PrecedenceGraph::nearest_blockade(
    const CoordinatedMotion& motion) const {
  const Blockade* nearest = nullptr;
  for (const Blockade& blockade : blockades_) {
    if (blockade.step != motion.step || motion.progress >= blockade.until) continue;
    if (nearest == nullptr || blockade.limit < nearest->limit) nearest = &blockade;
  }
  return nearest;
}

void PrecedenceGraph::renew_held_at() {
  held_at_.clear();
  for (const CoordinatedMotion& motion : motions_) {
    const Blockade* nearest = nearest_blockade(motion);
    held_at_.push_back(nearest != nullptr ? std::optional(nearest->limit) : std::nullopt);
  }
}

Blocker blocker_of(const Precedence& precedence) {
  const ConflictRegion& region = precedence.region();
  return {precedence.second(), precedence.first(), std::nullopt, turned_around(region.proximity),
          region.time_b,       region.time_a};
}

}  // namespace armloom
