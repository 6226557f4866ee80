#include "test/scheduler/ideal_arms.h"

#include <algorithm>
#include <cmath>

namespace armloom {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(2);
constexpr double kGone = 100.0;  // rad: no crossing is there

Duration scaled(Duration duration, double by) { return from_seconds(to_seconds(duration) * by); }

}  // namespace

IdealArms::IdealArms(const CellPtr& description, std::unique_ptr<const Policy> policy,
                     Crossings table, HabitsOf habits_of, std::uint64_t seed)
    : Bench(description, std::move(policy)),
      crossings(std::move(table)),
      habits_of_(std::move(habits_of)),
      random_(seed) {
  const Configuration home = description->home();
  q_.assign(home.data(), home.data() + home.size());
}

JobId IdealArms::submit(Submit submitted) {
  const std::vector<JobId> after = submitted.after;
  const std::vector<ArmId> arms = submitted.trajectory->arms();
  submitted.job = next_id();
  after_[submitted.job] = after;
  const bool is_given = submitted.alternatives.empty() && !submitted.terms.reorderable;
  for (const ArmId arm : arms) {
    if (is_given) of_arm_[arm].push_back(submitted.job);
  }
  take(submitted);
  return submitted.job;
}

IdealArms::Moving* IdealArms::find_moving(JobId job) {
  const auto found = std::ranges::find(moving_, job, &Moving::job);
  return found == moving_.end() ? nullptr : &*found;
}

bool IdealArms::moves(JobId job) const {
  return std::ranges::find(moving_, job, &Moving::job) != moving_.end();
}

Duration IdealArms::progress(JobId job) const {
  const auto found = std::ranges::find(moving_, job, &Moving::job);
  return found == moving_.end() ? this->job(job).progress : found->s;
}

std::size_t IdealArms::times_released(JobId job) const {
  return times_released_.contains(job) ? times_released_.at(job) : 0;
}

std::size_t IdealArms::times_dispatched(JobId job) const {
  return times_dispatched_.contains(job) ? times_dispatched_.at(job) : 0;
}

// ---- What happens next ----

bool IdealArms::go_on(TimePoint until) {
  if (question && answer_at_ == kNever) {
    answer_at_ = now_ + std::chrono::microseconds(500 + random_() % 8000);
  }
  TimePoint next = std::min(answer_at_, wake_at.value_or(kNever));
  for (const Moving& arm : moving_) next = std::min(next, arm.report_at);
  for (const OpenPlan& plan : plans_) next = std::min(next, plan.answer_at);
  const bool comes = next <= until && next != kNever;
  if (!comes) next = until;
  if (next == kNever) return false;
  next = std::max(next, now_);
  for (Moving& arm : moving_) advance(arm, next);
  now_ = next;
  if (!comes) return false;
  if (now_ >= answer_at_) return answer_now();
  if (answer_plan_now()) return true;
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    if (moving_[i].report_at > now_) continue;
    report(i);
    return true;
  }
  wake_at.reset();
  take(Wake{});
  return true;
}

bool IdealArms::answer_now() {
  answer_at_ = kNever;
  if (!question) return false;
  const Question asked = *std::exchange(question, std::nullopt);
  take(Judged{crossings.answer(asked)});
  return true;
}

// Returns false if no planning question is due.
bool IdealArms::answer_plan_now() {
  const auto due =
      std::ranges::find_if(plans_, [&](const OpenPlan& plan) { return plan.answer_at <= now_; });
  if (due == plans_.end()) return false;
  const PlanMotion asked = due->asked;
  plans_.erase(due);
  take(answer_to(asked));
  return true;
}

// Plans a path that avoids all arms at rest. If there is none, plans a path that avoids the arms
// that cannot move.
PlanMade IdealArms::answer_to(const PlanMotion& asked) const {
  const MotionGoal& goal = asked.question.goal;
  const auto arm = static_cast<std::uint32_t>(goal.arm.index());
  Configuration beside = asked.question.at;
  const double from = beside[arm];
  const auto* joints = std::get_if<Eigen::VectorXd>(&goal.to);
  const auto* link = std::get_if<LinkTarget>(&goal.to);
  PlanMade made{.step = asked.step, .question = asked.number, .trajectory = nullptr};
  if (joints == nullptr && link == nullptr) {
    made.none.why = "no place clear of it is known";
    return made;
  }
  const double to = joints != nullptr ? (*joints)[0] : link->X_WL.translation().x();
  const TrajectoryPtr way =
      move({arm}, from, to, 200ms + from_seconds(2.0 * std::abs(to - from) / goal.speed));
  if (crossings.free_beside(*way, beside)) {
    made.trajectory = way;
    return made;
  }
  for (const ArmId other : asked.question.may_move) beside[other.index()] = kGone;
  made.goes_through = crossings.free_beside(*way, beside);
  if (made.goes_through) made.trajectory = way;
  if (!made.goes_through) made.none.why = "others stand there";
  return made;
}

void IdealArms::run(std::size_t events_max) {
  for (std::size_t events = 0; go_on(kNever); ++events) {
    if (::testing::Test::HasFailure()) return;
    if (events < events_max) continue;
    ADD_FAILURE() << "still going on after " << events << " events";
    return;
  }
}

void IdealArms::take(const Input& input) {
  step(input, now_);
  check();
}

// ---- The arms ----

void IdealArms::advance(Moving& arm, TimePoint to) const {
  TimePoint from = std::max(now_, arm.moves_from);
  const Duration end = arm.braking ? arm.rests_at : arm.authority;
  while (from < to && arm.s < end) {
    const bool stalls =
        !arm.has_stalled && arm.habits.stalls_for > Duration{} && arm.habits.stalls_at > arm.s;
    const Duration target = stalls ? std::min(end, arm.habits.stalls_at) : end;
    const TimePoint there = from + scaled(target - arm.s, 1.0 / arm.habits.speed);
    if (there > to) {
      arm.s = std::min(target, arm.s + scaled(to - from, arm.habits.speed));
      arm.moved_at = to;
      return;
    }
    arm.s = target;
    arm.moved_at = there;
    from = there;
    if (!stalls || target < arm.habits.stalls_at) continue;
    arm.has_stalled = true;
    arm.moves_from = from = there + arm.habits.stalls_for;
  }
}

// Sets the time of the next report.
void IdealArms::plan_report(Moving& arm) {
  if (arm.braking) {
    arm.report_at = std::max(now_, arm.report_at);
    return;
  }
  const TimePoint begins = std::max(now_, arm.moves_from);
  if (arm.s >= arm.authority) {
    const bool known = arm.reported == arm.s && arm.s < arm.motion->duration();
    arm.report_at = known && arm.seen_to_stand ? kNever : now_ + kTick + arm.habits.feedback_age;
    return;
  }
  const auto tick = std::chrono::milliseconds(40 + random_() % 200);
  const Duration way = std::min<Duration>(tick, arm.authority - arm.s);
  arm.report_at = begins + scaled(way, 1.0 / arm.habits.speed) + Duration(1);
}

void IdealArms::report(std::size_t index) {
  Moving& arm = moving_[index];
  const bool rests = arm.s >= arm.motion->duration();
  if (arm.braking || rests) {
    const Moving rested = arm;
    moving_.erase(moving_.begin() + static_cast<std::ptrdiff_t>(index));
    come_to_rest(rested, rests ? MotionReport::Kind::finished : MotionReport::Kind::stopped);
    return;
  }
  const Duration old = scaled(arm.habits.feedback_age, arm.habits.speed);
  const bool stands = now_ - arm.moved_at >= arm.habits.feedback_age;
  const Duration before = arm.reported;
  arm.reported = stands ? arm.s : std::max(arm.reported, arm.s - old);
  arm.seen_to_stand = arm.reported == before;
  const JobId job = arm.job;
  const Duration told = arm.reported;
  plan_report(arm);
  take(MotionReport{only_step(job), MotionReport::Kind::progressed, told});
}

void IdealArms::come_to_rest(const Moving& arm, MotionReport::Kind kind) {
  MotionReport told{only_step(arm.job), kind, arm.s};
  arm.motion->sample_positions(arm.s, told.rest_position);
  for (std::size_t i = 0; i < arm.motion->arms().size(); ++i) {
    q_[arm.motion->arms()[i].index()] = told.rest_position[static_cast<Eigen::Index>(i)];
  }
  take(told);
}

// ---- Effects of the scheduler ----

void IdealArms::heard(const Effect& effect) {
  if (const auto* aside = std::get_if<YieldMove>(&effect))
    after_[aside->job] = job(aside->job).job->after;
  if (const auto* dispatch = std::get_if<Dispatch>(&effect)) on(*dispatch);
  if (const auto* grant = std::get_if<Grant>(&effect)) on(*grant);
  if (const auto* brake = std::get_if<Brake>(&effect)) on(*brake);
  if (const auto* plan = std::get_if<PlanMotion>(&effect)) on(*plan);
  if (const auto* release = std::get_if<Release>(&effect)) {
    const JobId id = release->step.job;
    ++times_released_[id];
    EXPECT_FALSE(moves(id)) << "released in motion";
    EXPECT_TRUE(is_terminal(state(id)) || !job(id).times.started_at);
  }
}

void IdealArms::on(const Dispatch& dispatch) {
  const Step& step = this->job(dispatch.step.job);
  ++times_dispatched_[step.id.job];
  for (const ArmId arm : step.trajectory->arms()) {
    EXPECT_FALSE(scheduler.stopped(arm)) << "a stopped arm is sent";
    for (const Moving& other : moving_) {
      const auto& arms = other.motion->arms();
      EXPECT_EQ(std::ranges::find(arms, arm), arms.end()) << "it moves already";
    }
    EXPECT_NEAR(place_of(*step.trajectory, arm, dispatch.from_progress), q_[arm.index()], 1e-6)
        << "it does not stand there";
    const auto& given = of_arm_[arm];
    if (std::ranges::find(given, step.id.job) == given.end()) continue;
    for (const JobId before : given) {
      if (before == step.id.job) break;
      EXPECT_TRUE(is_terminal(state(before))) << "out of the order of its arm";
    }
  }
  for (const JobId before : after_[step.id.job]) {
    EXPECT_EQ(state(before), JobState::succeeded) << "before what it comes after";
  }
  Habits habits = habits_of_(step.id.job);
  if (dispatch.from_progress > Duration{}) habits.stalls_for = {};
  moving_.push_back({.job = step.id.job,
                     .motion = step.trajectory,
                     .habits = habits,
                     .s = dispatch.from_progress,
                     .reported = dispatch.from_progress,
                     .authority = dispatch.authority,
                     .moves_from = std::max(now_, dispatch.start_at) + habits.starts_late,
                     .moved_at = now_,
                     .report_at = now_});
  EXPECT_GE(dispatch.authority, dispatch.from_progress);
  EXPECT_LE(dispatch.authority, step.trajectory->duration());
  plan_report(moving_.back());
}

void IdealArms::on(const Grant& grant) {
  Moving* arm = find_moving(grant.step.job);
  ASSERT_NE(arm, nullptr) << "authority for what does not move";
  EXPECT_FALSE(arm->braking) << "authority for what brakes";
  EXPECT_GT(grant.authority, arm->authority) << "it shrinks";
  EXPECT_LE(grant.authority, arm->motion->duration());
  arm->authority = grant.authority;
  plan_report(*arm);
}

void IdealArms::on(const Brake& brake) {
  Moving* arm = find_moving(brake.step.job);
  ASSERT_NE(arm, nullptr) << "what does not move brakes";
  EXPECT_FALSE(arm->braking) << "it brakes already";
  arm->braking = true;
  arm->rests_at =
      std::min(arm->authority, arm->s + scaled(arm->habits.brakes_for, arm->habits.speed));
  const Duration begins = std::max(Duration{}, arm->moves_from - now_);
  if (begins > Duration{} && arm->s == Duration{}) arm->rests_at = Duration{};  // not at all
  arm->moves_from = now_;
  arm->report_at = now_ + arm->habits.brakes_for + Duration(1);
}

void IdealArms::on(const PlanMotion& plan) {
  plans_.push_back({plan, now_ + std::chrono::microseconds(500 + random_() % 40'000)});
}

}  // namespace armloom
