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

// The arm is where it was, or was to be, when the question was asked.
bool is_as_asked(const State& state, const GoalWay& way, const Configuration& at, ArmId arm) {
  const auto& joints = state.cell->arm(arm).joints;
  const Eigen::VectorXd asked = joints_of(way.request.beside, joints);
  return joints_elsewhere(*state.cell, joints, asked, at).empty();
}

// It was asked for, or made, for where the arm will be and for the scene as it is.
bool fits(const State& state, const GoalWay& way, const Configuration& at) {
  const bool is_asked =
      way.request.beside.size() != 0 && way.request.asked_at >= state.around.scene_since;
  return is_asked && is_as_asked(state, way, at, way.goal.arm);
}

// What is admitted will come to its end, whoever came first.
bool comes_to_its_end(const Step& step) { return step.in<Queued>() == nullptr; }

// Where the arm comes to rest by what is admitted.
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

// Where the arm of this way will be when the job's turn comes; nothing: that is not known yet. What
// may yet go by another arm counts as if it did.
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

// In its turn: all that came before it is done, or is admitted, and its own arm is where the job
// finds it. Who was found in its way is passed where it comes to rest by what is admitted, whoever
// came first, and so for as long as it comes to rest there.
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

// It waits for an arm that it was not planned beside where that comes to rest: another job has
// overtaken it, or a move aside of our own has taken that arm there. Where no way past the others
// was found there may be one as soon as any of them is to rest elsewhere.
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
  PlanQuestion question = question_about(state, step, way, at);  // by what was found of it
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

// What is not known of the way, or is out of date, is asked.
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

// All of them; where one is planned, the job can be judged. An arm on which it cannot be planned
// yet does not keep it from going on another one: the jobs ahead of it there may wait for this one.
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
    take_alternative(state, step, *not_asked);  // among the jobs that it waits for
  if (not_asked && !(planned && has_turn_on_some_arm(state, step))) return Answered::not_asked;
  if (!planned) return any_stands_in ? Answered::stands_in : Answered::refused;
  if (step.has_open_arm() && *planned != goal.taken) take_alternative(state, step, *planned);
  state.set_planned(step, true);
  return Answered::planned;
}

// Where the first of those lead is not known: more than there are arms would be planned in vain.
// The first job of an arm is always one of them: those ahead of it may wait for jobs behind it.
bool is_one_of_the_first(const State& state, const Step& step, std::size_t place) {
  if (place == 0) return true;
  std::size_t before = 0;
  for (const Step& other : state.jobs.of(state.jobs.active().undecided())) {
    const bool is_put_off = other.state() == JobState::backlogged;
    if (other.has_open_arm() && !is_put_off && other.job->turn < step.job->turn) ++before;
  }
  return before < state.cell->arms.size();
}

// The first of a queue fails at once. A motion of a task behind others is planned again at its
// turn. Actions of a task before another job may yet move what is in its way.
bool may_yet_find_a_path(const State& state, const Step& step, std::size_t place) {
  if (place == 0) return false;
  if (step.job->task) return true;
  return std::ranges::any_of(state.jobs.of(state.jobs.active()), [&](const Step& other) {
    return other.job->turn < step.job->turn && any_closed(state, other, blocks_plan);
  });
}

// The first of the arm's jobs that is to fail; null: none.
const Step* plan_lane(Transitions& state, ArmId arm) {
  // As they stand now: a job may be taken to go by another arm meanwhile.
  const auto queue = state->jobs.queues()[arm];
  for (std::size_t i = 0; i < std::min(queue.size(), kPlannedAhead); ++i) {
    const Step& step = state->jobs.at(queue[i]);
    if (!step.goal || step.in<Queued>() == nullptr) continue;
    // What comes of it is seen when it is answered.
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

// By arm, where there are several.
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
