#include <fstream>
#include <iostream>

#include "core/planning/answer_plan.h"
#include "core/planning/plan_goal.h"
#include "core/trajectory/set_joints.h"
#include "server/codec/json_writer.h"
#include "server/command/command.h"
#include "server/messages/plan_goal.h"
#include "server/messages/trajectory_request.h"

namespace armloom {
namespace {

// At the option instead of the place in a message.
tl::unexpected<Problems> at_option(const char* option, Problems problems) {
  for (Problem& problem : problems) problem.pointer = option;
  return failure(std::move(problems));
}

void say(const PlanRefusal& refusal) {
  std::cerr << "armloom: no plan: " << refusal.detail << '\n';
  JsonWriter out;
  out.begin_object()
      .field("result", reason_name(refusal.reason))
      .field("detail", refusal.detail)
      .field("evaluations", refusal.evaluations);
  if (refusal.proximity) {
    out.key("links").begin_array().value(refusal.proximity->body_a);
    out.value(refusal.proximity->body_b).end_array();
    out.field("clearance_m", refusal.proximity->clearance_m);
  }
  out.end_object();
  std::cout << out.text() << '\n';
}

// The body of POST /jobs.
std::string job_text(const PlanOptions& options, const TrajectoryRequest& request) {
  JsonWriter out;
  out.begin_object().field("name", options.arm + ": to " + options.to.substr(0, 200));
  out.key("trajectory");
  trajectory_request_format()->write(out, request);
  out.end_object();
  return out.take();
}

Result<PlanQuestion> question_of(const PlanOptions& options, const Cell& cell) {
  const auto arm = find_arm(cell, options.arm);
  if (!arm) return at_option("--arm", arm.error());
  const auto said = read_plan_goal(options.to);
  if (!said) return at_option("--to", said.error());
  const auto goal = goal_of(cell, *arm, *said);
  if (!goal) return at_option("--to", goal.error());
  PlanQuestion question{.goal = *goal, .at = cell.home(), .seed = options.seed};
  if (options.from.empty()) return question;
  const auto from = read_plan_goal(options.from);
  if (!from) return at_option("--from", from.error());
  const auto q = joints_of(cell, *arm, *from);
  if (!q) return at_option("--from", q.error());
  set_joints(question.at, cell.arm(*arm).joints, *q);
  return question;
}

}  // namespace

int plan_way(const PlanOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const auto scene = PlanningScene::build(loaded->cell);
  if (!scene) return refuse(options.cell_file, scene.error());
  const auto question = question_of(options, *loaded->cell);
  if (!question) return refuse("plan", question.error());
  const auto planned = answer_plan(*scene, *question);
  if (!planned) return say(planned.error()), kExitFound;

  const std::string job = job_text(options, planned->timed.request);
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
  std::cerr << "armloom: " << options.arm << " in "
            << to_seconds(planned->timed.trajectory->duration()) << " s, by "
            << planned->way.points.size() - 2 << " corners, " << planned->way.length()
            << " of joint space; " << planned->way.evaluations << " evaluations\n";
  return kExitDone;
}

}  // namespace armloom
