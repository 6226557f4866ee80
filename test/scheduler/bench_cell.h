#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scheduler/scheduler.h"
#include "test/scheduler/one_joint_arms.h"

namespace armloom {

using namespace std::chrono_literals;

// Returns a quintic from rest to rest, each joint from its start to its goal.
inline TrajectoryPtr move(const std::vector<std::uint32_t>& arms, const std::vector<double>& from,
                          const std::vector<double>& to, Duration duration) {
  std::vector<JointId> joints;
  std::vector<ArmId> arm_ids;
  const double T = to_seconds(duration);
  Segment segment{.start = Duration{}, .duration = duration, .coefficients = {}};
  segment.coefficients.setZero(static_cast<Eigen::Index>(arms.size()), 6);
  for (std::size_t j = 0; j < arms.size(); ++j) {
    joints.emplace_back(arms[j]);
    arm_ids.emplace_back(arms[j]);
    const double d = to[j] - from[j];
    segment.coefficients.row(static_cast<Eigen::Index>(j)) << from[j], 0, 0, 10 * d / (T * T * T),
        -15 * d / (T * T * T * T), 6 * d / (T * T * T * T * T);
  }
  return std::make_shared<const Trajectory>(joints, arm_ids, std::vector<Segment>{segment});
}

inline TrajectoryPtr move(const std::vector<std::uint32_t>& arms, double from, double to,
                          Duration duration) {
  return move(arms, std::vector<double>(arms.size(), from), std::vector<double>(arms.size(), to),
              duration);
}

inline TrajectoryPtr visit(std::uint32_t arm, double home, double there, Duration duration) {
  const auto out = move({arm}, home, there, duration / 2),
             back = move({arm}, there, home, duration / 2);
  std::vector<Segment> segments{out->segments().front(), back->segments().front()};
  segments[1].start = segments[0].duration;
  return std::make_shared<const Trajectory>(out->joints(), out->arms(), std::move(segments));
}

// Returns a region of these boxes (times of the first motion, then of the second).
template <typename... Boxes>
ConflictRegion region(const Boxes&... boxes) {
  return {{boxes...}, Proximity{.body_a = "a", .body_b = "b", .clearance_m = 0.01}, 1s, 2s};
}

class Bench {
 public:
  virtual ~Bench() = default;
  explicit Bench(std::size_t arms, const char* policy = "certified")
      : Bench(one_joint_arms(arms), policy) {}
  Bench(const CellPtr& description, const char* policy)
      : Bench(description, std::move(*make_policy(policy, *description))) {}
  Bench(CellPtr description, std::unique_ptr<const Policy> policy)
      : cell(std::move(description)), scheduler(cell, std::move(policy), cell->home()) {}

  void step(const Input& input, TimePoint now) {
    for (Effect& effect : scheduler.step(input, now)) {
      heard(effect);
      if (auto* judge = std::get_if<Judge>(&effect)) question = std::move(judge->question);
      if (auto* wake = std::get_if<WakeAt>(&effect)) wake_at = wake->when;
      if (auto* p = std::get_if<PlanMotion>(&effect)) plans.push_back(std::move(*p));
      if (auto* d = std::get_if<Dispatch>(&effect)) dispatched.push_back(*d);
      if (auto* g = std::get_if<Grant>(&effect)) granted.push_back(*g);
      if (auto* b = std::get_if<Brake>(&effect)) braked.push_back(b->step.job);
      if (auto* m = std::get_if<YieldMove>(&effect)) asides.push_back(*m);
      if (auto* r = std::get_if<Release>(&effect)) released.push_back(r->step.job);
      if (auto* c = std::get_if<JobChanged>(&effect)) {
        const Step& step = *scheduler.find(c->job);
        if (step.has_ended()) ++terminal_events[c->job];
      }
    }
    EXPECT_TRUE(scheduler.state().graph.is_acyclic());
  }

  JobId submit(TrajectoryPtr trajectory, TimePoint now, Duration timeout = 60s, int priority = 0) {
    return submit(Submit{JobId{0}, std::move(trajectory), {priority, timeout}}, now);
  }
  JobId submit(Submit submitted, TimePoint now) {
    submitted.job = next_id();
    step(submitted, now);
    return submitted.job;
  }

  void answer_free(TimePoint now) {
    ASSERT_TRUE(question) << "nothing was asked";
    const Version version = question->version;
    question.reset();
    step(Judged{Verdict{Verdict::Kind::free, version, {}, {}, 1}}, now);
  }
  void answer_conflict(TimePoint now, Conflict::With with, std::optional<JobId> other = {},
                       std::optional<ArmId> arm = {}) {
    ASSERT_TRUE(question) << "nothing was asked";
    const Version version = question->version;
    const StepId candidate = question->candidates.front().step;
    const auto other_step = other ? std::optional(only_step(*other)) : std::nullopt;
    question.reset();
    const Proximity proximity{
        .body_a = "own", .body_b = "other", .arm_b = arm, .clearance_m = 0.01};
    step(Judged{Verdict{Verdict::Kind::conflict,
                        version,
                        {Conflict{with, candidate, other_step, proximity, 100ms, 200ms}},
                        {},
                        1}},
         now);
  }

  // Answers: free except for these regions.
  void answer_regions(TimePoint now, std::vector<PairRegions> regions) {
    ASSERT_TRUE(question) << "nothing was asked";
    Verdict verdict{Verdict::Kind::free, question->version, {}, {}, 1};
    verdict.regions = std::move(regions);
    question.reset();
    step(Judged{std::move(verdict)}, now);
  }

  // Answers: undecided, evaluation budget exhausted.
  void answer_exhausted(TimePoint now, Conflict::With with) {
    ASSERT_TRUE(question) << "nothing was asked";
    Verdict verdict{Verdict::Kind::undecided, question->version, {}, {}, 1};
    verdict.conflicts.push_back({with,
                                 question->candidates.front().step,
                                 {},
                                 Proximity{.body_a = "own", .body_b = "other"},
                                 100ms,
                                 200ms});
    verdict.exhausted = true;
    question.reset();
    step(Judged{std::move(verdict)}, now);
  }

  void progressed(JobId job, Duration progress, TimePoint now) {
    step(MotionReport{only_step(job), MotionReport::Kind::progressed, progress}, now);
  }
  void finished(JobId job, TimePoint now) {
    const auto& trajectory = scheduler.find(job)->trajectory;
    step(MotionReport{only_step(job), MotionReport::Kind::finished, trajectory->duration(),
                      trajectory->goal()},
         now);
  }
  void stopped(JobId job, Duration progress, TimePoint now) {
    const auto& trajectory = scheduler.find(job)->trajectory;
    JointState state;
    trajectory->sample(progress, state);
    step(MotionReport{only_step(job), MotionReport::Kind::stopped, progress, state.position}, now);
  }

  [[nodiscard]] JobId next_id() const { return scheduler.next_job(); }
  JobState state(JobId job) const { return scheduler.find(job)->state(); }
  const Step& job(JobId id) const { return *scheduler.find(id); }
  Duration authority(JobId id) const {
    Duration told{};
    for (const Dispatch& d : dispatched)
      told = d.step.job == id ? std::max(told, d.authority) : told;
    for (const Grant& g : granted) told = g.step.job == id ? std::max(told, g.authority) : told;
    return told;
  }

  CellPtr cell;
  Scheduler scheduler;
  std::optional<Question> question;
  std::optional<TimePoint> wake_at;
  std::vector<Dispatch> dispatched;
  std::vector<Grant> granted;
  std::vector<YieldMove> asides;
  std::vector<PlanMotion> plans;
  std::vector<JobId> braked, released;
  std::map<JobId, int> terminal_events;

 private:
  virtual void heard(const Effect& /*effect*/) {}
};

// One arm is half a second into its motion. The motion of a second arm has the region `box` with
// it.
struct OneBehindAnother {
  explicit OneBehindAnother(const ProgressBox& box) {
    first = bench.submit(move({0}, 0, 1, 2s), at(0ms));
    bench.answer_free(at(1ms));
    bench.progressed(first, 500ms, at(501ms));
    second = bench.submit(move({1}, 0, 1, 2s), at(502ms));
    bench.answer_regions(at(503ms), {{only_step(second), only_step(first), {region(box)}}});
  }
  Bench bench{2, "certified"};
  JobId first{0}, second{0};
};

}  // namespace armloom
