#include <algorithm>
#include <fstream>
#include <iostream>

#include "core/base/nearest_name.h"
#include "core/planning/plan_motion.h"
#include "core/planning/pose_goal.h"
#include "core/trajectory/set_joints.h"
#include "server/codec/json_writer.h"
#include "server/command/command.h"
#include "server/messages/plan_goal.h"
#include "server/messages/trajectory_request.h"

namespace armloom {
namespace {

using Goals = tl::expected<std::vector<Eigen::VectorXd>, PlanRefusal>;

tl::unexpected<Problems> fault(const char* option, const std::string& slug, std::string detail,
                               const std::string& value) {
  return failure(Problem{ProblemKind::invalid, slug, option, std::move(detail), value});
}

// "a, b and c" of what there is.
template <class Names>
std::string listed(const Names& names) {
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

Result<ArmId> find_arm(const Cell& cell, const std::string& name) {
  if (const auto arm = cell.find_arm(name)) return *arm;
  std::vector<std::string> names;
  for (const Arm& arm : cell.arms) names.push_back(arm.name);
  return fault("--arm", "unknown-arm", "the cell has no arm " + name + "; it has " + listed(names),
               name);
}

Result<Eigen::VectorXd> named_state(const Arm& arm, const std::string& name, const char* option) {
  if (const auto state = arm.named_states.find(name); state != arm.named_states.end()) {
    return state->second;
  }
  if (name == "home") return arm.home;
  std::string known = "home";
  for (const auto& [state, q] : arm.named_states) {
    if (state != "home") known += ", " + state;
  }
  return fault(option, "unknown-state",
               "arm " + arm.name + " has no named state " + name +
                   did_you_mean(name, arm.named_states) + "; it has " + known,
               name);
}

// Of joints or a name.
Result<Eigen::VectorXd> joints_of(const PlanGoal& goal, const Arm& arm, const char* option) {
  if (goal.named) return named_state(arm, *goal.named, option);
  if (goal.pose) {
    return fault(option, "not-served", "a pose does not say where each joint stands: give joints",
                 "pose");
  }
  if (goal.joints->size() != arm.joints.size()) {
    return fault(option, "size-mismatch",
                 "arm " + arm.name + " has " + std::to_string(arm.joints.size()) +
                     " joints, found " + std::to_string(goal.joints->size()) + " positions",
                 std::to_string(goal.joints->size()));
  }
  return Eigen::Map<const Eigen::VectorXd>(goal.joints->data(),
                                           static_cast<Eigen::Index>(goal.joints->size()));
}

Result<Goals> goals_of(const PlanGoal& goal, const Cell& cell, const PlanRequest& request) {
  const Arm& arm = cell.arm(request.arm);
  if (!goal.pose) {
    auto q = joints_of(goal, arm, "--to");
    if (!q) return failure(std::move(q.error()));
    return Goals(std::vector<Eigen::VectorXd>{*std::move(q)});
  }
  std::optional<LinkId> link;
  if (goal.pose->link) {
    link = cell.find_link(*goal.pose->link);
  } else {
    for (const LinkId id : arm.links) {
      if (cell.link(id).driver == arm.joints.back() && !link) link = id;
    }
  }
  if (!link) {
    const std::string name = goal.pose->link.value_or("");
    return fault("--to", "unknown-link", "the cell has no link " + name, name);
  }
  return reach_pose(cell, {request.arm, *link, goal.pose->X_WL}, request.at);
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

// The request, but for its goals.
Result<PlanRequest> request_of(const PlanOptions& options, const Cell& cell) {
  const auto arm = find_arm(cell, options.arm);
  if (!arm) return failure(arm.error());
  PlanRequest request{.arm = *arm, .at = cell.home(), .goals = {}, .seed = options.seed};
  if (options.from.empty()) return request;
  const auto from = read_plan_goal(options.from);
  if (!from) return failure(from.error());
  const auto q = joints_of(*from, cell.arm(*arm), "--from");
  if (!q) return failure(q.error());
  set_joints(request.at, cell.arm(*arm).joints, *q);
  return request;
}

}  // namespace

int plan_way(const PlanOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const auto scene = PlanningScene::build(loaded->cell);
  if (!scene) return refuse(options.cell_file, scene.error());
  auto request = request_of(options, *loaded->cell);
  if (!request) return refuse("plan", request.error());
  const auto to = read_plan_goal(options.to);
  if (!to) return refuse("--to", to.error());
  const auto goals = goals_of(*to, *loaded->cell, *request);
  if (!goals) return refuse("plan", goals.error());
  if (!*goals) return say(goals->error()), kExitFound;
  request->goals = **goals;
  const auto planned = plan_motion(Planner(*scene), *request);
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
