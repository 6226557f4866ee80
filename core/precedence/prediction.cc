#include "core/precedence/prediction.h"

#include <algorithm>

namespace armloom {
namespace {

constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

using Stage = Prediction::Stage;

// A limit that a motion may not pass before another motion has reached `until`.
struct Gate {
  Duration limit;
  std::size_t other;  // kNobody: it stays closed
  Duration until;
};

// Precondition: the motion reaches `progress`.
Duration time_at(std::span<const Stage> stages, Duration progress, double pace) {
  if (progress <= stages.front().progress) return Duration{};
  const auto after = std::ranges::lower_bound(stages, progress, {}, &Stage::progress);
  const Stage& from = *(after - 1);
  return from.time + paced(progress - from.progress, pace);
}

}  // namespace

// Predicts all motions at once, each as far as the motions that it waits for are predicted. The
// data of all motions are in shared arrays, so that no motion allocates memory.
class Race {
 public:
  Race(std::span<const CoordinatedMotion> motions, const MotionChains& chains,
       const std::vector<Dependency>& dependencies, const HeldAt& held_at)
      : motions_(motions), chains_(chains), runners_(motions.size()) {
    place_gates(dependencies, held_at);
    prediction_.first_.resize(motions.size());
    prediction_.count_.resize(motions.size());
    for (const CoordinatedMotion& motion : motions) {
      prediction_.pace_.push_back(motion.outlook.pace);
    }
    std::size_t stages = 0;
    for (std::size_t m = 0; m < motions.size(); ++m) {
      prediction_.first_[m] = stages;
      // Its start, a rest, two at each gate, its end.
      stages += 3 + 2 * (runners_[m].gates_end - runners_[m].next_gate);
    }
    prediction_.stages_.resize(stages);
  }

  Prediction run() {
    for (bool moved = true; moved;) {
      moved = false;
      for (std::size_t m = 0; m < runners_.size(); ++m) moved = advance(m) || moved;
    }
    for (std::size_t m = 0; m < runners_.size(); ++m) {
      const auto stages = prediction_.stages(m);
      prediction_.begins.push_back(stages.empty() ? Duration{} : begins(stages));
      prediction_.ends.push_back(stages.empty() ? Duration{} : stages.back().time);
      if (!runners_[m].ended) prediction_.stuck.push_back(m);
    }
    if (!prediction_.stuck.empty()) prediction_.ring = ring_from(prediction_.stuck.front());
    for (const std::size_t m : prediction_.stuck) come_to_gate(m);
    return std::move(prediction_);
  }

 private:
  struct Runner {
    std::size_t next_gate = 0;  // into gates_
    std::size_t gates_end = 0;
    std::size_t waits_for = 0;
    bool ended = false;
  };

  // Sorts the gates by motion, then by limit.
  void place_gates(const std::vector<Dependency>& dependencies, const HeldAt& held_at) {
    const auto each_gate = [&](auto&& take) {
      for (const Dependency& dependency : dependencies) {
        for (const Precedence::Step& step : dependency.precedence->steps()) {
          if (step.until <= motions_[dependency.first].progress) continue;  // passed
          take(dependency.second, Gate{step.limit, dependency.first, step.until});
        }
      }
      for (std::size_t m = 0; m < held_at.size(); ++m) {
        if (held_at[m]) take(m, Gate{*held_at[m], kNobody, {}});
      }
    };
    each_gate([this](std::size_t m, const Gate&) { ++runners_[m].gates_end; });
    std::size_t all = 0;
    for (Runner& runner : runners_) {
      runner.next_gate = all;
      all += runner.gates_end;
      runner.gates_end = runner.next_gate;
    }
    gates_.resize(all);
    each_gate([this](std::size_t m, const Gate& gate) { gates_[runners_[m].gates_end++] = gate; });
    for (const Runner& runner : runners_) {
      const auto begin = gates_.begin();
      std::stable_sort(begin + static_cast<std::ptrdiff_t>(runner.next_gate),
                       begin + static_cast<std::ptrdiff_t>(runner.gates_end),
                       [](const Gate& a, const Gate& b) { return a.limit < b.limit; });
    }
  }

  static Duration begins(std::span<const Stage> stages) {
    const Stage& first = stages.front();
    const bool waits = stages.size() > 1 && stages[1].progress == first.progress;
    return first.progress > Duration{} ? Duration{} : waits ? stages[1].time : first.time;
  }

  [[nodiscard]] Duration time_for(std::size_t m, Duration way) const {
    return paced(way, motions_[m].outlook.pace);
  }

  void add_stage(std::size_t m, Stage stage) {
    prediction_.stages_[prediction_.first_[m] + prediction_.count_[m]++] = stage;
  }

  // Adds the stage in which a stuck motion comes to rest.
  void come_to_gate(std::size_t m) {
    if (prediction_.count_[m] == 0) return;
    const Stage here = prediction_.stages(m).back();
    const Duration limit = gates_[runners_[m].next_gate].limit;
    if (limit > here.progress)
      add_stage(m, {limit, here.time + time_for(m, limit - here.progress)});
  }

  // Returns when the motion reaches `progress`; nullopt if that is not predicted yet.
  [[nodiscard]] std::optional<Duration> comes_to(std::size_t m, Duration progress) const {
    const Runner& runner = runners_[m];
    const auto stages = prediction_.stages(m);
    if (stages.empty()) return std::nullopt;
    if (progress <= stages.front().progress) return Duration{};
    const bool known = runner.ended || (runner.next_gate < runner.gates_end &&
                                        progress <= gates_[runner.next_gate].limit);
    if (!known) return std::nullopt;
    return time_at(stages, std::min(progress, motions_[m].duration), motions_[m].outlook.pace);
  }

  // Returns true if the motion may leave its start.
  bool sets_out(std::size_t m) {
    const CoordinatedMotion& motion = motions_[m];
    Duration start{};
    for (const std::size_t before : chains_.before(m)) {
      if (!runners_[before].ended) {
        runners_[m].waits_for = before;
        return false;
      }
      start = std::max(start, prediction_.stages(before).back().time);
    }
    add_stage(m, {motion.progress, start});
    const Duration stands = motion.outlook.stands_for;
    if (stands > Duration{}) add_stage(m, {motion.progress, start + stands});
    return true;
  }

  // Predicts the motion as far as possible. Returns true if it got any farther.
  bool advance(std::size_t m) {
    Runner& runner = runners_[m];
    if (runner.ended) return false;
    bool moved = false;
    if (prediction_.count_[m] == 0) {
      if (!sets_out(m)) return false;
      moved = true;
    }
    for (; runner.next_gate < runner.gates_end; ++runner.next_gate) {
      const Gate& gate = gates_[runner.next_gate];
      const auto opens = gate.other != kNobody ? comes_to(gate.other, gate.until) : std::nullopt;
      if (!opens) {
        runner.waits_for = gate.other != kNobody ? gate.other : m;
        return moved;
      }
      const Stage here = prediction_.stages(m).back();
      const Duration limit = std::max(gate.limit, here.progress);
      const Duration arrives = here.time + time_for(m, limit - here.progress);
      moved = true;
      if (*opens <= arrives) continue;
      const Duration loss = limit > Duration{} ? kPauseLoss : Duration{};
      if (limit > here.progress) add_stage(m, {limit, arrives});
      add_stage(m, {limit, *opens + loss});
    }
    const Stage here = prediction_.stages(m).back();
    const Duration duration = motions_[m].duration;
    add_stage(m, {duration, here.time + time_for(m, duration - here.progress)});
    runner.ended = true;
    return true;
  }

  // Returns a cycle: every stuck motion waits for a stuck motion.
  [[nodiscard]] std::vector<std::size_t> ring_from(std::size_t start) const {
    std::vector<std::size_t> way;
    std::size_t at = start;
    while (std::ranges::find(way, at) == way.end()) {
      way.push_back(at);
      at = runners_[at].waits_for;
    }
    way.erase(way.begin(), std::ranges::find(way, at));
    return way;
  }

  std::span<const CoordinatedMotion> motions_;
  const MotionChains& chains_;
  std::vector<Runner> runners_;
  std::vector<Gate> gates_;
  Prediction prediction_;
};

std::optional<Duration> Prediction::comes_to(std::size_t motion, Duration progress) const {
  const auto way = stages(motion);
  if (way.empty()) return std::nullopt;
  if (progress > way.back().progress) return std::nullopt;
  return time_at(way, progress, pace_[motion]);
}

std::optional<Duration> Prediction::goes_beyond(std::size_t motion, Duration progress) const {
  const auto way = stages(motion);
  const auto after = std::ranges::upper_bound(way, progress, {}, &Stage::progress);
  if (after == way.end()) return std::nullopt;
  if (after == way.begin()) return Duration{};
  const Stage& from = *(after - 1);
  return from.time + time_for(motion, progress - from.progress);
}

Prediction predict(std::span<const CoordinatedMotion> motions, const MotionChains& chains,
                   const std::vector<Dependency>& dependencies, const HeldAt& held_at) {
  return Race(motions, chains, dependencies, held_at).run();
}

}  // namespace armloom
