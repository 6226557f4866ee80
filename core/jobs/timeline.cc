#include "core/jobs/timeline.h"

#include <algorithm>
#include <utility>

#include "core/jobs/standing.h"
#include "core/jobs/waits.h"
#include "core/precedence/motion_chains.h"
#include "core/precedence/prediction.h"

namespace armloom {
namespace {

// The prediction for all admitted motions, read leg by leg.
class Timetable {
 public:
  Timetable(const State& state, TimePoint now)
      : state_(state),
        now_(now),
        motions_(state.graph.motions()),
        chains_(motions_),
        dependencies_(state.graph.dependencies()) {
    std::vector<CoordinatedMotion> motions = motions_;
    HeldAt held_at = state.graph.held_at();
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const bool is_stopped = held_by(m).has_value();
      stands_.push_back(is_stopped ? Duration{} : stood_for(*state.cell, job(m), now));
      if (is_stopped) held_at[m] = motions[m].progress;
      motions[m].outlook = {
          .stands_for = stands_[m],
          .pace = pace_of(*state.cell, job(m), state.speed.pace(motions[m].arms), now)};
    }
    prediction_ = predict(motions, chains_, dependencies_, held_at);
  }

  [[nodiscard]] PredictedLeg leg(std::size_t m) const {
    const bool stuck = is_stuck(m);
    PredictedLeg leg{
        .step = motions_[m].step, .starts = starts(m), .ends = {}, .pauses = pauses(m)};
    if (!stuck && job(m).ends_by_braking() == nullptr) leg.ends = now_ + prediction_.ends[m];
    if (stuck) leg.pauses.push_back(last_pause(m));
    return leg;
  }

 private:
  [[nodiscard]] const Step& job(std::size_t m) const { return state_.jobs.at(motions_[m].step); }

  // Returns what keeps the motion at rest for an unknown time: a stop, or what the last check of a
  // motion that rests on its path has found.
  [[nodiscard]] std::optional<Wait> held_by(std::size_t m) const {
    if (auto wait = operator_wait(state_, job(m))) return wait;
    const auto* held = job(m).in<Held>();
    const bool brakes = job(m).in<Braking>() != nullptr && job(m).ends_by_braking() == nullptr;
    const std::vector<Wait>* found = held != nullptr ? &held->judgement.found
                                     : brakes        ? &job(m).waits_on
                                                     : nullptr;
    return found != nullptr && !found->empty() ? std::optional(found->front()) : std::nullopt;
  }

  [[nodiscard]] bool is_stuck(std::size_t m) const {
    return std::ranges::binary_search(prediction_.stuck, m);
  }

  [[nodiscard]] std::optional<TimePoint> starts(std::size_t m) const {
    if (job(m).has_started()) return job(m).times.motion_started_at;
    const auto leaves = prediction_.goes_beyond(m, motions_[m].progress);
    return leaves ? std::optional(now_ + *leaves) : std::nullopt;
  }

  // Returns the pauses that end.
  [[nodiscard]] std::vector<PredictedPause> pauses(std::size_t m) const {
    std::vector<PredictedPause> pauses;
    const auto stages = prediction_.stages(m);
    for (std::size_t i = 1; i < stages.size(); ++i) {
      const Duration at = stages[i].progress, from = stages[i - 1].time, to = stages[i].time;
      if (stages[i - 1].progress < at || from >= to) continue;
      const bool of_its_own = i == 1 && stands_[m] > Duration{};
      const Duration loss = at > Duration{} ? kPauseLoss : Duration{};
      pauses.push_back(
          {now_ + from, now_ + to, at, of_its_own ? std::nullopt : waits_on(m, at, to - loss)});
    }
    return pauses;
  }

  // Returns the pause in which a stuck motion stays.
  [[nodiscard]] PredictedPause last_pause(std::size_t m) const {
    const auto stages = prediction_.stages(m);
    if (stages.empty()) return {now_, std::nullopt, motions_[m].progress, behind(m)};
    const auto [at, from] = stages.back();
    if (auto held = held_by(m)) return {now_ + from, std::nullopt, at, std::move(held)};
    const auto rests = state_.graph.rests_ahead(motions_[m].step);
    const bool is_blocked = rests && rests->limit() <= at;
    return {now_ + from, std::nullopt, at,
            is_blocked ? wait_for(rests->blocker()) : waits_on(m, at, std::nullopt)};
  }

  // Returns the wait for an earlier motion of its arms that never ends.
  [[nodiscard]] std::optional<Wait> behind(std::size_t m) const {
    for (const std::size_t before : chains_.before(m)) {
      if (is_stuck(before))
        return Wait{.kind = Wait::Kind::predecessor, .job = motions_[before].step.job};
    }
    return std::nullopt;
  }

  // Returns what the motion waits for at `at` until `opens`; nullopt for `opens`: forever.
  [[nodiscard]] std::optional<Wait> waits_on(std::size_t m, Duration at,
                                             std::optional<Duration> opens) const {
    for (const auto& [first, second, precedence] : dependencies_) {
      if (second != m) continue;
      for (const Precedence::Step& step : precedence->steps()) {
        if (step.limit > at || step.until <= motions_[first].progress) continue;
        const Duration until = std::min(step.until, motions_[first].duration);
        if (prediction_.comes_to(first, until) == opens) return wait_for(blocker_of(*precedence));
      }
    }
    return std::nullopt;
  }

  const State& state_;
  TimePoint now_;
  const std::vector<CoordinatedMotion>& motions_;
  MotionChains chains_;
  std::vector<Dependency> dependencies_;
  std::vector<Duration> stands_;
  Prediction prediction_;
};

}  // namespace

PredictedTimeline predicted_timeline(const State& state, TimePoint now) {
  PredictedTimeline timeline{.now = now, .legs = {}};
  const Timetable timetable(state, now);
  for (std::size_t m = 0; m < state.graph.motions().size(); ++m) {
    timeline.legs.push_back(timetable.leg(m));
  }
  return timeline;
}

}  // namespace armloom
