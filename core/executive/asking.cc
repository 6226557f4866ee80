// Checks jobs and plans paths to goals for clients, without any change of the state.
#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/base/add_below.h"
#include "core/executive/arms_of.h"
#include "core/executive/hands_together.h"
#include "core/executive/inquiry_desk.h"
#include "core/executive/timeline.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// Returns a question for each candidate arm; its `at` contains the start.
Result<std::vector<PlanQuestion>> questions_of(const Cell& cell, const PlanInquiry& inquiry,
                                               const Configuration& at) {
  Problems problems;
  auto goals = goals_of(cell, {inquiry.arm, inquiry.arms}, inquiry.to, "/to");
  if (!goals) return failure(std::move(goals.error()));
  std::vector<PlanQuestion> questions;
  for (MotionGoal& goal : *goals) {
    goal.speed = inquiry.speed.value_or(goal.speed);
    const ArmId arm = goal.arm;
    questions.push_back(
        {.goal = std::move(goal), .at = at, .seed = inquiry.seed, .budget = inquiry.budget});
    if (!inquiry.from) continue;
    auto start = joints_of(cell, arm, *inquiry.from);
    if (!start) add_below("/start", std::move(start.error()), problems);
    if (start) set_joints(questions.back().at, cell.arm(arm).joints, *start);
  }
  if (!problems.empty()) return failure(std::move(problems));
  return questions;
}

// Returns when the arm would arrive, from now, if the plan were a job; nullopt if not known.
std::optional<double> arrives_s(const PlanView& plan) {
  if (!plan.verdict || !plan.verdict->earliest_start_s) return std::nullopt;
  return *plan.verdict->earliest_start_s + to_seconds(plan.takes);
}

std::string why_another(const std::optional<double>& arrives, const PlanView& best) {
  if (!arrives) return "its arrival time is not known";
  const auto first = arrives_s(best);
  char text[96];
  std::snprintf(text, sizeof text, "it would arrive in %.2f s, %s in %.2f s", *arrives,
                best.arm.c_str(), first.value_or(0.0));
  return text;
}

using RefusedArms = std::vector<std::pair<std::string, PlanRefusal>>;

}  // namespace

// Points at a joint or the named state if the goal has them, otherwise at the whole pose.
void point_at_goal(const std::string& place, const PlanGoal& said, RefusedInquiry& refused) {
  if (said.named) {
    refused.pointer = place + "/named";
    refused.value = *said.named;
  } else if (said.joints && refused.why.outside) {
    refused.pointer = place + "/joints/" + std::to_string(refused.why.outside->joint);
    refused.value = refused.why.outside->position;
  } else {
    refused.pointer = place + (said.joints ? "/joints" : "/pose");
  }
}

namespace {

// Points at the part of the inquiry that is at fault.
RefusedInquiry placed(const PlanInquiry& inquiry, const std::string& arm, PlanRefusal why) {
  using Reason = PlanRefusal::Reason;
  RefusedInquiry refused{std::move(why)};
  if (refused.why.reason == Reason::not_found || refused.why.reason == Reason::cancelled) {
    return refused;
  }
  if (!refused.why.is_of_start()) {
    point_at_goal("/to", inquiry.to, refused);
  } else if (inquiry.from) {
    point_at_goal("/start", *inquiry.from, refused);
  } else {
    const auto which = std::ranges::find(inquiry.arms, arm) - inquiry.arms.begin();
    refused.pointer = inquiry.arms.empty() ? "/arm" : "/arms/" + std::to_string(which);
    refused.value = arm;
  }
  return refused;
}

// Joins the refusals of all arms; the first one gives the kind.
RefusedInquiry refusal_of(const PlanInquiry& inquiry, const RefusedArms& all) {
  RefusedInquiry refused = placed(inquiry, all.front().first, all.front().second);
  if (all.size() == 1) return refused;
  refused.why.detail.clear();
  refused.why.evaluations = 0;
  for (const auto& [arm, one] : all) {
    refused.why.detail += (refused.why.detail.empty() ? "" : "; ") + arm + ": " + one.detail;
    refused.why.evaluations += one.evaluations;
  }
  return refused;
}

// Returns the best plan, with the other arms and the reasons against them.
PlanOutcome first_of(const PlanInquiry& inquiry, std::vector<PlanView> plans,
                     const RefusedArms& refused) {
  if (plans.empty()) return tl::unexpected(refusal_of(inquiry, refused));
  const auto when = [](const PlanView& plan) {
    return arrives_s(plan).value_or(std::numeric_limits<double>::infinity());
  };
  const auto best = std::ranges::min_element(plans, {}, when);
  PlanView view = std::move(*best);
  plans.erase(best);
  for (const PlanView& other : plans) {
    const auto arrives = arrives_s(other);
    view.others.push_back({other.arm, arrives, why_another(arrives, view)});
  }
  for (const auto& [arm, why] : refused) {
    view.others.push_back({arm, std::nullopt, "no plan: " + why.detail});
  }
  return view;
}

}  // namespace

Problem too_many_open(const std::string& what) {
  return {ProblemKind::unavailable, "too-many-" + what, "",
          "too many " + what + " are open; retry in a moment"};
}

void InquiryDesk::check(JobRequest request, std::function<void(Result<CheckView>)> done) {
  JobIntake::Ahead ahead = intake_.ahead();
  Configuration at = ahead.rest;
  auto prepared = intake_.prepare(std::move(request), ahead);
  if (!prepared) return done(failure(std::move(prepared.error())));
  if (!prepared->steps.empty()) {
    return check_steps(*std::move(prepared), std::move(at), std::move(done));
  }
  Submit job = intake_.submission(std::move(*prepared));
  job.job = scheduler_.next_job();
  const auto judged = [this, version = scene_.version(), done = std::move(done)](TrialEnd end) {
    if (!end) return done(failure(std::move(end.error())));
    CheckView view = view_of(*end, *cell_, jobs_);
    view.scene_version = version;
    done(std::move(view));
  };
  walk(std::make_shared<Trial>(scheduler_, open_now(), std::vector{job}, job.job, clock_.now),
       scene_.scene(), judged);
}

Trial::Open InquiryDesk::open_now() const {
  return {questions_.asked(), questions_.plans().open()};
}

// Answers the trial's questions one after the other.
void InquiryDesk::walk(std::shared_ptr<Trial> trial, PlanningScenePtr scene,
                       std::function<void(TrialEnd)> done) {
  if (auto question = trial->next()) {
    const auto answered = [this, trial, scene, done](Verdict verdict) {
      trial->answer(std::move(verdict));
      walk(trial, scene, done);
    };
    if (questions_.service().consider(std::move(*question), scene, answered)) return;
    return done(failure(too_many_open("checks")));
  }
  if (const auto plan = trial->next_plan()) {
    const auto answered = [this, trial, scene, plan, done](PlanAnswer answer) {
      trial->answer(made_of(*plan, std::move(answer)));
      walk(trial, scene, done);
    };
    const auto cancelled = std::make_shared<std::atomic<bool>>(false);
    if (questions_.service().draft(
            {plan->question, scene, cancelled, answered, plan->known.has_value()}))
      return;
    return done(failure(too_many_open("plans")));
  }
  done(trial->outcome());
}

// Returns the arms that may leave their places before a motion that is planned now.
std::vector<ArmId> InquiryDesk::may_move(const std::vector<ArmId>& staying) const {
  std::vector<ArmId> arms = all_arms(*cell_);
  std::erase_if(
      arms, [&](ArmId arm) { return std::ranges::count(staying, arm) > 0 || !jobs_.has_job(arm); });
  return arms;
}

struct InquiryDesk::OpenInquiry {
  PlanInquiry inquiry;
  std::vector<PlanQuestion> questions;
  std::shared_ptr<std::atomic<bool>> cancelled;
  std::function<void(Result<PlanOutcome>)> done;
  std::size_t next = 0;  // of the questions
  std::vector<PlanView> plans = {};
  RefusedArms refused = {};
};

void InquiryDesk::plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                       std::function<void(Result<PlanOutcome>)> done) {
  auto questions = questions_of(*cell_, inquiry, predicted_rest(scheduler_.state()));
  if (!questions) return done(failure(std::move(questions.error())));
  const HandsOf hands = intake_.hands(intake_.ahead());
  for (std::size_t i = 0; i < questions->size(); ++i) {
    const std::string place = inquiry.arms.empty() ? "/arm" : "/arms/" + std::to_string(i);
    auto alone = find_moves_alone(*cell_, hands, {(*questions)[i].goal.arm}, place);
    if (alone) return done(failure(*std::move(alone)));
  }
  for (PlanQuestion& question : *questions) question.may_move = may_move({question.goal.arm});
  plan_next(std::make_shared<OpenInquiry>(OpenInquiry{std::move(inquiry), *std::move(questions),
                                                      std::move(cancelled), std::move(done)}));
}

void InquiryDesk::plan_next(const std::shared_ptr<OpenInquiry>& inquiry) {
  if (inquiry->next == inquiry->questions.size()) {
    return inquiry->done(first_of(inquiry->inquiry, std::move(inquiry->plans), inquiry->refused));
  }
  PlanQuestion question = inquiry->questions[inquiry->next++];
  const std::string arm = cell_->arm(question.goal.arm).name;
  const auto judge = [this, inquiry, arm](PlanAnswer answer) {
    if (!answer) {
      inquiry->refused.emplace_back(arm, std::move(answer.error()));
      return plan_next(inquiry);
    }
    const std::vector<Eigen::VectorXd> points = answer->way.points;
    JobRequest job{.key = "", .name = "", .trajectory = answer->timed.request};
    PlanView view{.arm = arm, .others = {}, .motion = *std::move(answer)};
    view.takes = scheduler_.state().time_for(*view.motion.timed.trajectory);
    view.length = view.motion.way.length();
    view.straight_line_length = (points.back() - points.front()).norm();
    check(std::move(job), [this, inquiry, view = std::move(view)](auto verdict) mutable {
      view.verdict = std::move(verdict);
      inquiry->plans.push_back(std::move(view));
      plan_next(inquiry);
    });
  };
  PlanTask task{std::move(question), scene_.scene(), inquiry->cancelled, judge};
  if (questions_.service().draft(std::move(task))) return;
  inquiry->done(failure(too_many_open("plans")));
}

void InquiryDesk::diagram(const std::string& key_a, const std::string& key_b,
                          std::function<void(Result<DiagramView>)> done) {
  questions_.drawings().draw({key_a, key_b, scene_.now(), clock_.now}, std::move(done));
}

TrajectoryPtr InquiryDesk::trajectory(const std::string& key) const {
  const auto id = jobs_.find(key);
  return id ? scheduler_.find(tasks_.present_motion(*id))->trajectory : nullptr;
}

TimelineView InquiryDesk::timeline() const {
  return {scheduler_.timeline(clock_.now), scheduler_.policy().lookahead.horizon,
          publisher_.board()->read()};
}

}  // namespace armloom
