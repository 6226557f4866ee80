#include "core/collision/check/timed_discrete_check.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace armloom {
namespace {

// A pair that rests or moves in parallel may seem closer by this much, because of rounding.
constexpr double kSameDistance_m = 1e-6;

struct Runner {
  const Motion* motion;
  bool candidate;
  Duration progress;  // trajectory time
  bool moved = true;  // moved since the last instant
};

// A pair that has been too close since the first instant.
struct Parting {
  PairId pair;
  double first_clearance_m;
  bool still_close;
};

class Judgement {
 public:
  // If `stay`, motions that may stay (Motion::Stands::may_stay) do.
  Judgement(const Question& question, ClearanceQuery& query, bool stay)
      : question_(question),
        stay_(stay),
        step_(std::get<TimedDiscrete>(question.method).step),
        query_(query),
        cell_(query.scene().cell()),
        q_(question.rest),
        runner_of_arm_(cell_.arms.size(), nullptr),
        of_candidates_(cell_.arms.size(), false),
        moved_(cell_.arms.size(), true) {
    if (step_ <= Duration::zero()) {
      throw std::invalid_argument("timed_discrete_check: the time step must be positive");
    }
    if (static_cast<std::size_t>(question.rest.size()) != cell_.joints.size()) {
      throw std::invalid_argument(
          "timed_discrete_check: rest must have one entry per joint of the cell");
    }
    runners_.reserve(question.candidates.size() + question.others.size());
    for (const Motion& motion : question.candidates) add(motion, true);
    for (const Motion& motion : question.others) add(motion, false);
    for (const Runner& runner : runners_) fastest_ = std::max(fastest_, runner.motion->share);
  }

  Verdict run() {
    Duration end = Duration::zero();
    for (const Runner& runner : runners_) {
      if (stays(*runner.motion)) continue;
      const Duration remaining = runner.motion->remaining();
      end = std::max(end, from_seconds(to_seconds(remaining) / rate_of(*runner.motion)));
    }
    Verdict verdict{Verdict::Kind::free, question_.version, {}, std::nullopt, 0};
    for (Duration t = Duration::zero();; t = std::min(t + step_, end)) {
      const bool first = t == Duration::zero();
      if (advance(t, first) || first) {
        ++verdict.evaluations;
        look(first, verdict.conflicts);
        if (!verdict.conflicts.empty()) {
          verdict.kind = Verdict::Kind::conflict;
          return verdict;
        }
      }
      if (t >= end) return verdict;
    }
  }

 private:
  [[nodiscard]] bool stays(const Motion& motion) const {
    return motion.stands == Motion::Stands::stays || rate_of(motion) == 0.0 ||
           (stay_ && motion.stands == Motion::Stands::may_stay);
  }

  // Time is scaled so that the fastest motion has rate one: then a step takes no motion farther
  // than without speed override.
  [[nodiscard]] double rate_of(const Motion& motion) const {
    return fastest_ > 0.0 ? motion.share / fastest_ : 0.0;
  }

  void add(const Motion& motion, bool candidate) {
    runners_.push_back({&motion, candidate, Duration::zero()});
    for (const ArmId arm : motion.trajectory->arms()) {
      if (runner_of_arm_[arm.index()] != nullptr) {
        throw std::invalid_argument("timed_discrete_check: two motions of arm " +
                                    cell_.arm(arm).name);
      }
      runner_of_arm_[arm.index()] = &runners_.back();
      of_candidates_[arm.index()] = candidate;
    }
  }

  // Moves every motion to time t; returns true if any moved.
  bool advance(Duration t, bool first) {
    bool any = false;
    for (Runner& runner : runners_) {
      const double rate = rate_of(*runner.motion);
      const Duration ahead = stays(*runner.motion) ? Duration::zero()
                             : rate == 1.0         ? t
                                                   : from_seconds(to_seconds(t) * rate);
      const Duration progress = std::clamp(runner.motion->progress + ahead, Duration::zero(),
                                           runner.motion->trajectory->duration());
      runner.moved = first || progress != runner.progress;
      runner.progress = progress;
      if (!runner.moved) continue;
      any = true;
      runner.motion->trajectory->sample_positions(progress, positions_);
      const std::vector<JointId>& joints = runner.motion->trajectory->joints();
      for (std::size_t i = 0; i < joints.size(); ++i) {
        q_[static_cast<Eigen::Index>(joints[i].index())] = positions_[static_cast<Eigen::Index>(i)];
      }
    }
    if (first) return any;
    for (std::size_t arm = 0; arm < moved_.size(); ++arm) {
      moved_[arm] = runner_of_arm_[arm] != nullptr && runner_of_arm_[arm]->moved;
    }
    return any;
  }

  void look(bool first, std::vector<Conflict>& conflicts) {
    query_.near_pairs(q_, of_candidates_, moved_, near_);
    if (first && question_.may_part) {
      for (const NearPair& near : near_) {
        parting_.push_back({near.pair, near.clearance_m, true});
      }
      return;
    }
    for (Parting& parting : parting_) {
      parting.still_close = !query_.looks_at(parting.pair, of_candidates_, moved_);
    }
    for (const NearPair& near : near_) {
      const auto parting = std::find_if(parting_.begin(), parting_.end(),
                                        [&](const Parting& p) { return p.pair == near.pair; });
      if (parting != parting_.end()) {
        parting->still_close = true;
        if (near.clearance_m >= parting->first_clearance_m - kSameDistance_m) continue;
      }
      report(near, conflicts);
    }
    std::erase_if(parting_, [](const Parting& parting) { return !parting.still_close; });
  }

  // Adds the conflict. If a conflict with the same counterpart is known, keeps only the closer
  // pair.
  void report(const NearPair& near, std::vector<Conflict>& conflicts) const {
    Conflict found = conflict_of(near);
    for (Conflict& known : conflicts) {
      if (!same_counterpart(known, found)) continue;
      if (found.proximity.clearance_m < known.proximity.clearance_m) known = std::move(found);
      return;
    }
    conflicts.push_back(std::move(found));
  }

  [[nodiscard]] const Runner* runner_of(std::optional<ArmId> arm) const {
    return arm ? runner_of_arm_[arm->index()] : nullptr;
  }

  [[nodiscard]] Conflict conflict_of(const NearPair& near) const {
    Proximity proximity = query_.describe(near);
    const Runner* own = runner_of(proximity.arm_a);
    const Runner* other = runner_of(proximity.arm_b);
    // Body a belongs to the candidate. If both bodies do, body a is that of the candidate named
    // first.
    const bool b_is_own =
        other != nullptr && other->candidate && (own == nullptr || !own->candidate || other < own);
    if (b_is_own) {
      std::swap(own, other);
      proximity = turned_around(std::move(proximity));
    }
    Conflict conflict{Conflict::With::scene, own->motion->step, std::nullopt,
                      std::move(proximity),  own->progress,     Duration::zero()};
    if (query_.is_self(near.pair) || own == other) {
      conflict.with = Conflict::With::self;
    } else if (other != nullptr) {
      conflict.with = Conflict::With::motion;
      conflict.other_step = other->motion->step;
      conflict.other_time = other->progress;
    } else if (conflict.proximity.arm_b) {
      conflict.with = Conflict::With::rest;
    }
    return conflict;
  }

  static bool same_counterpart(const Conflict& a, const Conflict& b) {
    if (a.with != b.with || a.candidate != b.candidate || a.other_step != b.other_step)
      return false;
    if (a.with == Conflict::With::rest) return a.proximity.arm_b == b.proximity.arm_b;
    return a.with != Conflict::With::scene || a.proximity.body_b == b.proximity.body_b;
  }

  const Question& question_;
  const bool stay_;
  const Duration step_;
  double fastest_ = 0.0;  // largest Motion::share
  ClearanceQuery& query_;
  const Cell& cell_;
  Configuration q_;
  std::vector<Runner> runners_;               // candidates first
  std::vector<const Runner*> runner_of_arm_;  // by ArmId; null if at rest
  std::vector<bool> of_candidates_;           // by ArmId
  std::vector<bool> moved_;                   // by ArmId: moved since the last instant
  std::vector<Parting> parting_;
  std::vector<NearPair> near_;
  Eigen::VectorXd positions_;
};

}  // namespace

Verdict timed_discrete_check(const Question& question, ClearanceQuery& query) {
  Verdict goes_on = Judgement(question, query, false).run();
  const bool may_stay = std::ranges::any_of(question.others, [](const Motion& motion) {
    return motion.stands == Motion::Stands::may_stay;
  });
  if (goes_on.kind != Verdict::Kind::free || !may_stay) return goes_on;
  Verdict stays = Judgement(question, query, true).run();
  stays.evaluations += goes_on.evaluations;
  return stays;
}

}  // namespace armloom
