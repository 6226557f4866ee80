#include "core/scheduler/ways/replanning.h"

#include <algorithm>
#include <utility>

#include "core/jobs/phases.h"
#include "core/jobs/standing.h"
#include "core/jobs/waits.h"
#include "core/scheduler/motion_questions.h"
#include "core/scheduler/ways/path_requests.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Slower than this share of its speed no other way is planned.
constexpr double kSlowest = 0.01;
// Seeds of further tries differ from those of other jobs.
constexpr std::uint64_t kSeedsOfOneTry = std::uint64_t{1} << 32;

ArmId arm_of(const Job& job) { return job.trajectory->arms().front(); }

// As fast as its own way was at its fastest.
double speed_of(const Cell& cell, const Trajectory& motion) {
  double share = kSlowest;
  for (const SegmentBounds& bounds : motion.bounds()) {
    for (std::size_t j = 0; j < motion.joints().size(); ++j) {
      const double speed = bounds.speed[static_cast<Eigen::Index>(j)];
      share = std::max(share, speed / cell.joint(motion.joints()[j]).velocity_max);
    }
  }
  return std::min(share, 1.0);
}

// A pose that others begin at is reached as it was planned; a straight line stays one.
MotionGoal goal_of(const State& state, const Job& job, Configuration end) {
  const ArmId arm = arm_of(job);
  const bool is_last = state.jobs.queues()[arm].back() == job.step();
  if (job.goal && (is_last || job.goal->way().goal.straight)) return job.goal->way().goal;
  follow_to_end(end, *state.cell, arm, *job.trajectory);
  return {.arm = arm,
          .to = joints_of(end, state.cell->arm(arm).joints),
          .speed = job.goal ? job.goal->way().goal.speed : speed_of(*state.cell, *job.trajectory)};
}

PlanQuestion question_about(const State& state, const Record& record) {
  const Job& job = record.job;
  const Configuration at = rest_after_admitted(state, &job);
  PlanQuestion question{.goal = goal_of(state, job, at),
                        .at = at,
                        .seed = job.id.value() + kSeedsOfOneTry * record.asking.plans};
  if (job.another_way->cause != AnotherWay::Cause::client)
    return question;  // they are what it shall pass
  for (std::uint32_t arm = 0; arm < state.cell->arms.size(); ++arm) {
    const bool moves = ArmId{arm} != question.goal.arm && !state.jobs.queues()[ArmId{arm}].empty();
    if (moves) question.may_move.push_back(ArmId{arm});
  }
  return question;
}

bool is_same_place(const State& state, const Configuration& a, const Configuration& b) {
  return a.size() == b.size() &&
         (a - b).cwiseAbs().maxCoeff() <= state.cell->execution.start_tolerance_rad;
}

// For what it was asked: the arm begins there, in that scene.
bool fits(const State& state, const Record& record) {
  const AnotherWay& other = *record.job.another_way;
  const auto& joints = state.cell->arm(arm_of(record.job)).joints;
  const Eigen::VectorXd from = joints_of(other.request.beside, joints);
  const Eigen::VectorXd stands = joints_of(rest_after_admitted(state, &record.job), joints);
  return other.request.asked_at >= state.scene_epoch && is_same_place(state, from, stands);
}

void ask_at_rest(State& state, Record& record) {
  Job& job = record.job;
  AnotherWay& other = *job.another_way;
  if (!job.is_waiting() || other.request.question) return;
  send(state, record, other.request, question_about(state, record));
}

void expire(State& state, Record& record, const std::string& why) {
  const char* where = record.job.has_started() ? " on its path" : " in the backlog";
  give_up(state, record,
          {AfterStop::Then::fail, Reason::backlog_timeout,
           "waited " + seconds_text(*record.job.terms.backlog_timeout) + where +
               "; no other path: " + why});
}

}  // namespace

std::optional<std::string> why_not_replanned(const Job& job) {
  if (job.trajectory->arms().size() > 1) return "it moves several arms together";
  if (job.goal) return std::nullopt;
  if (!job.alternatives.empty()) return "it has several alternatives";
  const bool is_loop = job.trajectory->start().isApprox(job.trajectory->goal());
  if (!is_loop) return std::nullopt;
  return "it ends where it begins, so a new path would drop all of its motion";
}

void ask_for_another_way(State& state, Record& record, AnotherWay::Cause cause) {
  Job& job = record.job;
  if (job.is_unplanned() || job.is_replanned_now()) return;
  if (job.has_open_arm()) state.jobs.decide_arm(record);
  if (!job.another_way) job.another_way.emplace();
  job.another_way->cause = cause;
  if (cause == AnotherWay::Cause::client) job.another_way->request.tries = 0;
  job.another_way->is_open = true;
  job.another_way->refusal.reset();
  state.jobs.being_replanned().insert(job.id);
  if (job.has_authority()) brake(state, record, {});
  ask_at_rest(state, record);
  state.jobs.explain(record);
  state.jobs.changed(record);
}

void plan_other_ways(State& state) {
  for (JobId id : std::set<JobId>(state.jobs.being_replanned())) {
    Record* record = state.jobs.find(id);
    if (record == nullptr || record->job.has_ended()) {
      state.jobs.being_replanned().erase(id);
      continue;
    }
    if (record->job.in<Admitted>() != nullptr) brake(state, *record, {});  // it had not moved
    ask_at_rest(state, *record);
  }
}

bool take_other_way(State& state, Record& record, const PlanMade& answer) {
  if (!record.job.is_replanned_now()) return false;
  AnotherWay& other = *record.job.another_way;
  if (!record.job.is_waiting()) return false;  // it is braking, and asks again
  const bool is_fit = fits(state, record);
  if (!is_fit && other.request.tries < kReplansMax) {
    ask_at_rest(state, record);
    return false;
  }
  other.is_open = false;
  state.jobs.being_replanned().erase(record.job.id);
  state.jobs.explain(record);
  state.jobs.changed(record);
  if (answer.trajectory && is_fit) {
    ++other.done;
    set_out_anew(state, record, answer.trajectory);
    if (record.job.goal) {  // it is the plan to its goal from now on
      GoalWay& way = record.job.goal->way();
      way.request.beside = other.request.beside;
      way.request.asked_at = other.request.asked_at;
      record.job.goal->detour.reset();
    }
    return true;
  }
  other.refusal =
      is_fit ? answer.why : "plan was out of date: the arm had moved or the scene had changed";
  if (other.cause == AnotherWay::Cause::timeout) expire(state, record, *other.refusal);
  return false;
}

bool may_go_around(const State& state, const Record& record) {
  const Job& job = record.job;
  if (state.cell->scheduling.on_idle_blocker != OnIdleBlocker::replan) return false;
  if (job.is_unplanned() || why_not_replanned(job)) return false;
  if (job.is_replanned_now()) return true;
  if (!job.is_waiting() && !job.pausing()) return false;
  if (!job.another_way) return true;
  const bool is_as_tried =
      job.another_way->request.asked_at >= state.scene_epoch &&
      is_same_place(state, job.another_way->request.beside, rest_after_admitted(state, &job));
  return job.another_way->request.tries < kReplansMax && !is_as_tried;
}

bool goes_around_idle_arm(State& state) {
  for (JobId id : state.jobs.past_queue()) {
    Record& record = state.jobs.at(id);
    const std::vector<Wait>* waits = known_waits(state, record.job);
    if (waits == nullptr || record.job.is_replanned_now()) continue;
    const bool for_idle_arm =
        std::ranges::any_of(*waits, [&](const Wait& wait) { return is_idle_arm(state, wait); });
    if (!for_idle_arm || !may_go_around(state, record)) continue;
    ask_for_another_way(state, record, AnotherWay::Cause::blocked);
    return true;
  }
  return false;
}

bool goes_on_after_timeout(State& state, Record& record) {
  const Job& job = record.job;
  if (job.is_replanned_now()) return true;
  if (job.terms.on_timeout != OnTimeout::replan || job.is_unplanned() || why_not_replanned(job))
    return false;
  if (job.another_way && job.another_way->request.tries >= kReplansMax) return false;
  ask_for_another_way(state, record, AnotherWay::Cause::timeout);
  return true;
}

}  // namespace armloom
