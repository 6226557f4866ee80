#include "server/messages/plan.h"

#include <fstream>
#include <iostream>

#include "core/planning/answer_plan.h"
#include "core/planning/plan_goal.h"
#include "core/trajectory/set_joints.h"
#include "server/codec/json_writer.h"
#include "server/command/command.h"
#include "server/command/progress.h"
#include "server/messages/plan_goal.h"
#include "server/messages/trajectory_request.h"

namespace armloom {
namespace {

// Returns, for example, "--to /pose/xyz".
std::string place_in(const char* option, std::string_view pointer) {
  return std::string(option) + (pointer.empty() ? "" : " ") + std::string(pointer);
}

tl::unexpected<Problems> at_option(const char* option, Problems problems) {
  for (Problem& problem : problems) problem.pointer = place_in(option, problem.pointer);
  return failure(std::move(problems));
}

using RefusedArm = std::pair<std::string, PlanRefusal>;

void say(const std::vector<RefusedArm>& refused) {
  const PlanRefusal& first = refused.front().second;
  std::string detail;
  std::uint64_t evaluations = 0;
  for (const auto& [arm, refusal] : refused) {
    const std::string whose = refused.size() > 1 ? arm + ": " : "";
    detail += (detail.empty() ? "" : "; ") + whose + refusal.detail;
    evaluations += refusal.evaluations;
  }
  if (first.reason == PlanRefusal::Reason::not_found) {
    detail += ": increase --budget or try another --seed";
  }
  std::cerr << "armloom: no plan: " << detail << '\n';
  JsonWriter out;
  out.begin_object()
      .field("result", reason_name(first.reason))
      .field("detail", detail)
      .field("evaluations", evaluations);
  if (const auto links = links_of(first); !links.empty()) {
    out.key("links").begin_array();
    for (const std::string& link : links) out.value(link);
    out.end_array();
  }
  if (first.proximity) {
    out.field("clearance_m", first.proximity->clearance_m);
    out.field("required_clearance_m", first.proximity->limit_m);
  }
  if (first.nearest) {
    out.key("nearest").begin_array();
    for (const double position : *first.nearest) out.value(position);
    out.end_array();
  }
  out.end_object();
  std::cout << out.text() << '\n';
}

std::string job_text(const std::string& arm, const std::string& to,
                     const TrajectoryRequest& request) {
  JsonWriter out;
  out.begin_object().field("name", arm + ": to " + to.substr(0, 200));
  out.key("trajectory");
  trajectory_request_format()->write(out, request);
  out.end_object();
  return out.take();
}

Result<std::vector<PlanQuestion>> questions_of(const PlanOptions& options, const Cell& cell) {
  const auto said = read_plan_goal(options.to);
  if (!said) return at_option("--to", said.error());
  auto goals = goals_of(cell, {options.arm, options.arms}, *said, "/to");
  if (!goals) {
    Problems problems = std::move(goals.error());
    for (Problem& problem : problems) {
      constexpr std::string_view kTo = "/to";
      std::string_view place = problem.pointer;
      const bool is_arm = place.starts_with("/arm");
      if (place.starts_with(kTo)) place.remove_prefix(kTo.size());
      problem.pointer = !is_arm                ? place_in("--to", place)
                        : options.arms.empty() ? "--arm"
                                               : "--arms";
    }
    return failure(std::move(problems));
  }
  const auto from = options.from.empty() ? Result<PlanGoal>{PlanGoal{.named = "home"}}
                                         : read_plan_goal(options.from);
  if (!from) return at_option("--from", from.error());
  std::vector<PlanQuestion> questions;
  for (MotionGoal& goal : *goals) {
    const ArmId arm = goal.arm;
    PlanQuestion question{.goal = std::move(goal), .at = cell.home(), .seed = options.seed};
    question.budget = options.budget;
    if (!options.from.empty()) {
      const auto q = joints_of(cell, arm, *from);
      if (!q) return at_option("--from", q.error());
      set_joints(question.at, cell.arm(arm).joints, *q);
    }
    questions.push_back(std::move(question));
  }
  return questions;
}

// Returns the arm with the shortest motion and this motion, or nullopt if no arm has a plan. Adds
// the arms without a plan, with their reasons, to `refused`.
std::optional<std::pair<std::string, PlannedMotion>> first_there(
    const PlanningScenePtr& scene, const std::vector<PlanQuestion>& questions,
    std::vector<RefusedArm>& refused) {
  std::optional<std::pair<std::string, PlannedMotion>> best;
  for (const PlanQuestion& question : questions) {
    const std::string& arm = scene->cell().arm(question.goal.arm).name;
    auto planned = answer_plan(scene, question);
    if (!planned) {
      refused.emplace_back(arm, std::move(planned.error()));
      continue;
    }
    const auto lasts = [](const PlannedMotion& motion) {
      return motion.timed.trajectory->duration();
    };
    if (!best || lasts(*planned) < lasts(best->second)) best.emplace(arm, *std::move(planned));
  }
  return best;
}

}  // namespace

int plan_way(const PlanOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const auto scene = PlanningScene::build(loaded->cell);
  if (!scene) return refuse(options.cell_file, scene.error());
  const auto questions = questions_of(options, *loaded->cell);
  if (!questions) return refuse("plan", questions.error());
  std::vector<RefusedArm> refused;
  const auto first = [&] {
    const Progress progress("plan");
    return first_there(*scene, *questions, refused);
  }();
  if (!first) return say(refused), kExitFound;
  const auto& [arm, planned] = *first;

  const std::string job = job_text(arm, options.to, planned.timed.request);
  if (options.out.empty()) {
    std::cout << job << '\n';
  } else {
    std::ofstream file(options.out);
    file << job << '\n';
    if (!file.flush()) {
      return refuse("plan", {Problem{ProblemKind::invalid, "cannot-write", "--out",
                                     "cannot write " + options.out, options.out}});
    }
  }
  std::cerr << "armloom: " << arm << " in " << to_seconds(planned.timed.trajectory->duration())
            << " s, path with " << planned.way.points.size() - 2 << " corners, length "
            << planned.way.length() << " in joint space; " << planned.way.evaluations
            << " evaluations\n";
  return kExitDone;
}

}  // namespace armloom
