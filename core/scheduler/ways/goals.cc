#include "core/scheduler/ways/goals.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/scheduler/waiting/gates.h"
#include "core/scheduler/waiting/options.h"
#include "core/scheduler/ways/path_requests.h"
#include "core/trajectory/joints_elsewhere.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Returns true if the arm is where the last question for this path assumed it.
bool is_as_asked(const State& state, const GoalWay& way, const Configuration& at, ArmId arm) {
  const auto& joints = state.cell->arm(arm).joints;
  const Eigen::VectorXd asked = joints_of(way.request.beside, joints);
  return joints_elsewhere(*state.cell, joints, asked, at).empty();
}

// Returns true if the last question was about the arm's present start and the present scene.
bool fits(const State& state, const GoalWay& way, const Configuration& at) {
  const bool is_asked =
      way.request.beside.size() != 0 && way.request.asked_at >= state.around.scene_since;
  return is_asked && is_as_asked(state, way, at, way.goal.arm);
}

// Admitted jobs reach their ends, even if they were submitted later.
bool comes_to_its_end(const Step& step) { return step.in<Queued>() == nullptr; }

// Moves `at` to where the arm's admitted jobs leave it.
void follow_admitted(Configuration& at, const State& state, ArmId arm) {
  for (const Step& step : state.jobs.of(state.jobs.queues()[arm])) {
    if (comes_to_its_end(step)) follow_to_end(at, *state.cell, arm, *step.trajectory);
  }
}

bool is_found_in_the_way(const State& state, const Step& step, ArmId arm) {
  if (!step.is_waiting() || !state.is_judged(step)) return false;
  return std::ranges::any_of(step.judgement().found, [arm](const Wait& wait) {
    const bool of_an_arm = wait.kind == Wait::Kind::arm || wait.kind == Wait::Kind::job;
    return of_an_arm && wait.arm == arm;
  });
}

// Returns where the arms are at the job's turn; nullopt if that is not known yet. Jobs whose arm is
// open are assumed to take another one.
std::optional<Configuration> at_its_turn(const State& state, const Step& step, const GoalWay& way) {
  if (any_closed(state, step, blocks_plan)) return std::nullopt;
  const ArmId arm = way.goal.arm;
  Configuration at = state.arms.rest();
  const auto& queue = state.jobs.queues()[arm];
  const bool is_taken = step.goal->way().goal.arm == arm;
  std::size_t before = is_taken ? queue.size() : place_on(state, step, arm);
  for (const Step& other : state.jobs.of(queue)) {
    if (before-- == 0 || other.id == step.id) break;
    if (other.has_open_arm()) continue;
    if (other.is_unplanned() || any_closed(state, other, blocks_plan)) return std::nullopt;
    follow_to_end(at, *state.cell, arm, *other.trajectory);
  }
  return at;
}

// Asks for a path at the job's turn, when the earlier jobs are done. An arm that was found in the
// way is passed where its admitted jobs leave it, as long as they leave it there.
PlanQuestion question_about(const State& state, const Step& step, const GoalWay& way,
                            Configuration at) {
  PlanQuestion question{.goal = way.goal, .seed = step.id.job.value()};
  const Step* helped =
      step.job->errand.before ? state.jobs.find(*step.job->errand.before) : nullptr;
  const JobId turn = helped != nullptr ? helped->job->turn : step.job->turn;
  for (std::uint32_t a = 0; a < state.cell->arms.size(); ++a) {
    const ArmId arm{a};
    if (arm == way.goal.arm) continue;
    question.may_move.push_back(arm);
    follow_admitted(at, state, arm);
    const bool was_passed_there =
        way.request.beside.size() != 0 && is_as_asked(state, way, at, arm);
    if (was_passed_there || is_found_in_the_way(state, step, arm)) continue;
    for (const Step& other : state.jobs.of(state.jobs.queues()[arm])) {
      const bool goes_before = other.job->turn < turn && !comes_to_its_end(other) &&
                               other.knows_its_end() && !other.has_open_arm();
      if (goes_before) follow_to_end(at, *state.cell, arm, *other.trajectory);
    }
  }
  question.at = std::move(at);
  return question;
}

// Returns true if an arm blocks the job and rests elsewhere than planned, because a job or a
// retreat came first. If no path past the other arms was found, any change of their rests is
// enough.
bool is_to_pass_another_place(const State& state, const Step& step, const GoalWay& way,
                              const Configuration& at) {
  Configuration rest = way.goes_through ? question_about(state, step, way, at).at : at;
  for (std::uint32_t a = 0; a < state.cell->arms.size(); ++a) {
    const ArmId arm{a};
    if (arm == way.goal.arm) continue;
    if (is_found_in_the_way(state, step, arm)) {
      follow_admitted(rest, state, arm);
    } else if (!way.goes_through) {
      continue;
    }
    if (!is_as_asked(state, way, rest, arm)) return true;
  }
  return false;
}

void ask(Transitions& state, const Step& step, std::size_t which, const Configuration& at) {
  GoalWay way = step.goal->ways[which];
  PlanQuestion question = question_about(state, step, way, at);  // needs the last check
  state.set_planned(step, false);
  way.is_planned = false;
  way.refusal.reset();
  way.stands_in.reset();
  way.request = send(state, step, ForGoal{which}, std::move(way.request), std::move(question));
  state.jobs().set(step, which, std::move(way));
}

enum class Answered {
  planned,
  stands_in,  // something that has to go before it can be planned (Step::stands_in)
  refused,
  not_yet,
  not_asked,  // where its arm will be is not known before a job ahead of it is planned
};

// Requests the plan if it is missing or out of date.
Answered answer_of(Transitions& state, const Step& step, std::size_t which) {
  const GoalWay& way = step.goal->ways[which];
  if (step.plans.is_open(ForGoal{which})) return Answered::not_yet;
  const auto at = at_its_turn(state, step, way);
  if (!at) return Answered::not_asked;
  if (fits(state, way, *at)) {
    if (!way.is_planned && !way.stands_in) return Answered::refused;
    if (way.request.tries != 0) {
      GoalWay answered = way;
      answered.request.tries = 0;
      state.jobs().set(step, which, std::move(answered));
    }
    if (way.stands_in) return Answered::stands_in;
    if (!is_to_pass_another_place(state, step, way, *at)) return Answered::planned;
  }
  if (way.request.tries < kPlansMax) {
    const bool was_planned = way.request.beside.size() != 0 && way.is_planned;
    if (was_planned) state.jobs().set(step, std::optional<Detour>());
    ask(state, step, which, *at);
    return Answered::not_yet;
  }
  GoalWay refused = way;
  refused.is_planned = false;
  refused.refusal = "planned " + std::to_string(kPlansMax) +
                    " times, and each plan was out of date: the arm had moved or the scene had "
                    "changed";
  state.jobs().set(step, which, std::move(refused));
  return Answered::refused;
}

// Combines the answers for all candidate arms. One plan is enough for a check. An arm without an
// answer does not hold the job back, because the jobs before it on that arm may wait for this job.
Answered answer_of(Transitions& state, const Step& step) {
  const JobGoal& goal = *step.goal;
  bool all = true, any_stands_in = false;
  std::optional<std::size_t> planned, not_asked;
  for (std::size_t k = 0; k < goal.ways.size(); ++k) {
    if (!step.has_open_arm() && k != goal.taken) continue;
    const Answered answer = answer_of(state, step, k);
    if (answer == Answered::not_yet) all = false;
    if (answer == Answered::not_asked && (!not_asked || k == goal.taken)) not_asked = k;
    if (answer == Answered::stands_in) any_stands_in = true;
    if (answer == Answered::planned && (!planned || k == goal.taken)) planned = k;
  }
  if (!all) return Answered::not_yet;
  if (not_asked && !planned && *not_asked != goal.taken)
    take_alternative(state, step, *not_asked);  // so that it queues behind them
  if (not_asked && !(planned && has_turn_on_some_arm(state, step))) return Answered::not_asked;
  if (!planned) return any_stands_in ? Answered::stands_in : Answered::refused;
  if (step.has_open_arm() && *planned != goal.taken) take_alternative(state, step, *planned);
  state.set_planned(step, true);
  return Answered::planned;
}

// Returns true if the job's arm may be planned although it is open. Jobs before it have unknown
// ends, so only as many are planned as there are arms. An arm's first job is always planned,
// because earlier jobs may wait for jobs behind it.
bool is_one_of_the_first(const State& state, const Step& step, std::size_t place) {
  if (place == 0) return true;
  std::size_t before = 0;
  for (const Step& other : state.jobs.of(state.jobs.active().undecided())) {
    const bool is_put_off = other.state() == JobState::backlogged;
    if (other.has_open_arm() && !is_put_off && other.job->turn < step.job->turn) ++before;
  }
  return before < state.cell->arms.size();
}

// The first job of a queue fails at once. A motion of a task behind others is planned again at its
// turn. Other jobs are planned again if actions of an earlier task may still clear the way.
bool may_yet_find_a_path(const State& state, const Step& step, std::size_t place) {
  if (place == 0) return false;
  if (step.job->task) return true;
  return std::ranges::any_of(state.jobs.of(state.jobs.active()), [&](const Step& other) {
    return other.job->turn < step.job->turn && any_closed(state, other, blocks_plan);
  });
}

// Returns the arm's first job that must fail; null if there is none.
const Step* plan_lane(Transitions& state, ArmId arm) {
  // Copied, because a job may move to another arm meanwhile.
  const auto queue = state->jobs.queues()[arm];
  for (std::size_t i = 0; i < std::min(queue.size(), kPlannedAhead); ++i) {
    const Step& step = state->jobs.at(queue[i]);
    if (!step.goal || step.in<Queued>() == nullptr) continue;
    if (step.is_replanned_now()) return nullptr;
    if (step.has_open_arm() && !is_one_of_the_first(state, step, i)) continue;
    const Answered answer = answer_of(state, step);
    if (answer == Answered::refused && !may_yet_find_a_path(state, step, i)) return &step;
    if (answer != Answered::planned && !step.has_open_arm()) return nullptr;
  }
  return nullptr;
}

// The job has no path, and is planned again after ActionsDone.
bool waits_to_retry(Transitions& state, const Step& step) {
  if (step.job->retries == 0) return false;
  Job job = *step.job;
  --job.retries;
  job.awaits_actions = true;
  state.jobs().set(step, std::move(job));
  for (std::size_t k = 0; k < step.goal->ways.size(); ++k) {
    GoalWay way = step.goal->ways[k];
    way.request = {};
    state.jobs().set(step, k, std::move(way));
  }
  return true;
}

// Lists the refusals by arm if there are several.
std::string why_none(const State& state, const Step& step) {
  if (!step.has_open_arm()) return *step.goal->way().refusal;
  std::string text;
  for (const GoalWay& way : step.goal->ways) {
    text += (text.empty() ? "" : "; ") + state.cell->arm(way.goal.arm).name + ": " + *way.refusal;
  }
  return text;
}

}  // namespace

bool plan_goals(Transitions& state) {
  bool any_failed = false;
  if (!state->jobs.active().have_goals()) return any_failed;
  for (std::uint32_t arm = 0; arm < state->cell->arms.size(); ++arm) {
    while (const Step* step = plan_lane(state, ArmId{arm})) {
      if (waits_to_retry(state, *step)) continue;
      state.end(*step, JobState::failed, Reason::no_plan, why_none(state, *step));
      any_failed = true;
    }
  }
  return any_failed;
}

void forget_plan(Transitions& state, const Step& step) {
  GoalWay way = step.goal->way();
  way.is_planned = false;
  way.request.beside = {};  // fits nowhere
  state.jobs().set(step, step.goal->taken, std::move(way));
  state.set_planned(step, false);
}

void take_goal_plan(Transitions& state, const Step& step, std::size_t which,
                    const PlanMade& answer) {
  GoalWay way = step.goal->ways[which];
  if (answer.trajectory) {
    way.is_planned = true;
    way.goes_through = answer.goes_through;
  } else {
    way.refusal = answer.none.why;
    way.stands_in = answer.none.stands_in;
  }
  state.jobs().set(step, which, std::move(way));
  if (answer.trajectory) state.take_plan(step, which, answer.trajectory);
}

}  // namespace armloom
