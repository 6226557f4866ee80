#include "core/scheduler/orders/prediction.h"

#include <algorithm>

namespace armloom {
namespace {

// A place that a motion may not pass before another one has got somewhere.
struct Gate {
  Duration limit;
  std::optional<std::size_t> other;  // nothing: it stays closed
  Duration until;
};

using Stage = Prediction::Stage;

// Precondition: it comes there.
Duration time_at(const std::vector<Stage>& stages, Duration progress) {
  if (progress <= stages.front().progress) return Duration{};
  const auto after = std::ranges::lower_bound(stages, progress, {}, &Stage::progress);
  const Stage& from = *(after - 1);
  return from.time + progress - from.progress;
}

struct Runner {
  std::vector<Gate> gates;  // by limit
  std::size_t next_gate = 0;
  std::vector<Stage> stages;
  bool ended = false;
  std::size_t waits_for = 0;

  // When it comes to `progress`; nothing: not known yet.
  [[nodiscard]] std::optional<Duration> comes_to(Duration progress, Duration duration) const {
    if (stages.empty()) return std::nullopt;
    if (progress <= stages.front().progress) return Duration{};
    const bool known = ended || (next_gate < gates.size() && progress <= gates[next_gate].limit);
    return known ? std::optional(time_at(stages, std::min(progress, duration))) : std::nullopt;
  }
};

class Race {
 public:
  Race(const std::vector<MotionAhead>& motions, const std::vector<Dependency>& dependencies)
      : motions_(motions), runners_(motions.size()) {
    for (const Dependency& dependency : dependencies) {
      for (const Precedence::Step& step : dependency.precedence->steps()) {
        if (step.until <= motions_[dependency.first].progress) continue;  // passed
        runners_[dependency.second].gates.push_back({step.limit, dependency.first, step.until});
      }
    }
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      if (const auto& at = motions_[m].held_at) runners_[m].gates.push_back({*at, {}, {}});
    }
    for (Runner& runner : runners_) {
      std::ranges::stable_sort(runner.gates, {}, &Gate::limit);
    }
  }

  Prediction run() {
    for (bool moved = true; moved;) {
      moved = false;
      for (std::size_t m = 0; m < runners_.size(); ++m) moved = advance(m) || moved;
    }
    Prediction prediction;
    for (const Runner& runner : runners_) {
      const Duration last = runner.stages.empty() ? Duration{} : runner.stages.back().time;
      prediction.begins.push_back(runner.stages.empty() ? Duration{} : begins(runner));
      prediction.ends.push_back(last);
    }
    for (std::size_t m = 0; m < runners_.size(); ++m) {
      if (!runners_[m].ended) prediction.stuck.push_back(m);
    }
    if (!prediction.stuck.empty()) prediction.ring = ring_from(prediction.stuck.front());
    for (Runner& runner : runners_) {
      if (!runner.ended && !runner.stages.empty()) come_to_gate(runner);
      prediction.stages.push_back(std::move(runner.stages));
    }
    return prediction;
  }

 private:
  static Duration begins(const Runner& runner) {
    const Stage& first = runner.stages.front();
    const bool waits = runner.stages.size() > 1 && runner.stages[1].progress == first.progress;
    return first.progress > Duration{} ? Duration{} : waits ? runner.stages[1].time : first.time;
  }

  static void come_to_gate(Runner& runner) {
    const Stage here = runner.stages.back();
    const Duration limit = runner.gates[runner.next_gate].limit;
    if (limit > here.progress) runner.stages.push_back({limit, here.time + limit - here.progress});
  }

  // As far as is known; whether that is any farther.
  bool advance(std::size_t m) {
    Runner& runner = runners_[m];
    const MotionAhead& motion = motions_[m];
    if (runner.ended) return false;
    bool moved = false;
    if (runner.stages.empty()) {
      Duration start{};
      for (const std::size_t before : motion.after) {
        if (!runners_[before].ended) {
          runner.waits_for = before;
          return false;
        }
        start = std::max(start, runners_[before].stages.back().time);
      }
      runner.stages.push_back({motion.progress, start});
      if (motion.stands_for > Duration{}) {
        runner.stages.push_back({motion.progress, start + motion.stands_for});
      }
      moved = true;
    }
    for (; runner.next_gate < runner.gates.size(); ++runner.next_gate) {
      const Gate& gate = runner.gates[runner.next_gate];
      const std::size_t other = gate.other.value_or(m);
      const auto opens = gate.other ? runners_[other].comes_to(gate.until, motions_[other].duration)
                                    : std::nullopt;
      if (!opens) {
        runner.waits_for = other;
        return moved;
      }
      const Stage here = runner.stages.back();
      const Duration limit = std::max(gate.limit, here.progress);
      const Duration arrives = here.time + (limit - here.progress);
      moved = true;
      if (*opens <= arrives) continue;
      const Duration loss = limit > Duration{} ? kPauseLoss : Duration{};
      if (limit > here.progress) runner.stages.push_back({limit, arrives});
      runner.stages.push_back({limit, *opens + loss});
    }
    const Stage here = runner.stages.back();
    runner.stages.push_back({motion.duration, here.time + (motion.duration - here.progress)});
    runner.ended = true;
    return true;
  }

  // Every one that is stuck waits for one that is stuck.
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

  const std::vector<MotionAhead>& motions_;
  std::vector<Runner> runners_;
};

}  // namespace

std::optional<Duration> Prediction::comes_to(std::size_t motion, Duration progress) const {
  const std::vector<Stage>& way = stages[motion];
  if (way.empty()) return std::nullopt;
  if (progress > way.back().progress) return std::nullopt;
  return time_at(way, progress);
}

std::optional<Duration> Prediction::goes_beyond(std::size_t motion, Duration progress) const {
  const std::vector<Stage>& way = stages[motion];
  const auto after = std::ranges::upper_bound(way, progress, {}, &Stage::progress);
  if (after == way.end()) return std::nullopt;
  if (after == way.begin()) return Duration{};
  const Stage& from = *(after - 1);
  return from.time + progress - from.progress;
}

Prediction predict(const std::vector<MotionAhead>& motions,
                   const std::vector<Dependency>& dependencies) {
  return Race(motions, dependencies).run();
}

}  // namespace armloom
