#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "core/executive/status_board.h"
#include "server/api/query_format.h"
#include "server/api/route.h"
#include "server/messages/arm.h"
#include "server/messages/plain_text.h"

namespace armloom {
namespace {

void list_arms(Call call) {
  const auto arms = arms_of(call.parts.loop.board().read(), *call.parts.cell);
  call.respond(answer(200, arm_list_format(), arms));
}

// Returns the arm that the path names. If the cell has no such arm, answers 404 and returns
// nullopt.
std::optional<ArmId> named_arm(const Call& call) {
  const auto arm = call.parts.cell->find_arm(call.arguments.front());
  if (!arm) call.respond(no_such_arm(call.parts, call.arguments.front()));
  return arm;
}

void get_arm(Call call) {
  const auto arm = named_arm(call);
  if (!arm) return;
  const auto arms = arms_of(call.parts.loop.board().read(), *call.parts.cell);
  call.respond(answer(200, arm_format(), arms[arm->index()]));
}
struct StopQuery {
  int category = 2;
};
const QueryFormat<StopQuery>& stop_query() {
  static const QueryFormat<StopQuery> format(
      {query::whole_number<StopQuery>(
          "category", &StopQuery::category, 0, 2,
          "Stop category of IEC 60204-1, default 2. 2: brake on the path, then hold the position. "
          "1: brake on the path, then switch the drives off. 0: switch the drives off at once: "
          "moving arms leave their paths, and their jobs fail")},
      ProblemKind::malformed);
  return format;
}
// How to stop. A faulty request still stops, with category 2; it is then answered with `faults`.
struct StopOrder {
  StopCategory category = StopCategory::brake;
  Problems faults;
};
// `who`: the arms, as the subject of a sentence.
StopOrder stop_order(const Call& call, const std::string& who) {
  StopOrder order{.faults = call.faults};
  const auto query = stop_query().read(call.request.target);
  if (!query) std::ranges::copy(query.error(), std::back_inserter(order.faults));
  if (order.faults.empty()) {
    order.category = static_cast<StopCategory>(query->category);
  } else {
    order.faults.front().detail += ". " + who + " stopped with category 2";
  }
  return order;
}

void stop_arm(Call call) {
  const auto arm = named_arm(call);
  if (!arm) return;
  const StopOrder order = stop_order(call, "Arm " + call.arguments.front() + " was");
  ask_urgently(
      call.parts,
      [arm = *arm, category = order.category](Executive& executive) {
        executive.stop({arm}, "operator", category);
        return executive.arms()[arm.index()];
      },
      [respond = call.respond, faults = order.faults](const ArmView& view) {
        respond(faults.empty() ? answer(202, arm_format(), view) : problem_response(faults));
      });
}
// While the store refuses writes, answers 503 and returns true: nothing may be resumed then.
bool is_held_by_store(const Call& call) {
  auto refusal = refusal_of_store(call.parts);
  if (!refusal) return false;
  refusal->status = 503;
  call.respond(refusal_response(*refusal));
  return true;
}

void resume_arm(Call call) {
  if (is_held_by_store(call)) return;
  const auto arm = named_arm(call);
  if (!arm) return;
  ask_urgently(
      call.parts,
      [arm = *arm](Executive& executive) -> Result<ArmView> {
        const bool is_resumed = executive.resume({arm}).empty();
        ArmView view = executive.arms()[arm.index()];
        if (is_resumed) return view;
        return failure(Problem{ProblemKind::conflict, "link-lost", "",
                               "arm " + view.name + " stays stopped: " + view.link_detail +
                                   ". Resume it when GET /arms/" + view.name + " shows link \"up\"",
                               view.name});
      },
      [respond = call.respond](const Result<ArmView>& view) {
        respond(view ? answer(202, arm_format(), *view) : problem_response(view.error()));
      });
}

void stop_all(Call call) {
  const auto asked = std::chrono::steady_clock::now();
  const StopOrder order = stop_order(call, "All arms were");
  ask_urgently(
      call.parts,
      [&parts = call.parts, asked, category = order.category](Executive& executive) {
        stop_all(executive, "operator", category);
        parts.metrics.stop_taken(std::chrono::steady_clock::now() - asked);
        return Stopped{.stopped = true, .category = static_cast<int>(category)};
      },
      [respond = call.respond, faults = order.faults](const Stopped& now) {
        respond(faults.empty() ? answer(202, stopped_format(), now) : problem_response(faults));
      });
}
void resume_all(Call call) {
  if (is_held_by_store(call)) return;
  ask_urgently(
      call.parts,
      [](Executive& executive) {
        const std::vector<ArmId> absent = resume_all(executive);
        Stopped now{.stopped = absent.size() == executive.arms().size()};
        for (const ArmId arm : absent)
          now.not_resumed.push_back(executive.arms()[arm.index()].name);
        return now;
      },
      [respond = call.respond](const Stopped& now) {
        respond(answer(202, stopped_format(), now));
      });
}

void get_speed(Call call) {
  call.respond(answer(200, speed_override_format(),
                      SpeedShare{call.parts.loop.board().read().speed_override}));
}
void get_arm_speed(Call call) {
  const auto arm = named_arm(call);
  if (!arm) return;
  const auto arms = arms_of(call.parts.loop.board().read(), *call.parts.cell);
  call.respond(answer(200, arm_speed_format(), arms[arm->index()]));
}

// Sets the speed override of the arm, or of the cell, and responds when it is stored.
template <class Answer>
void set_speed(const ApiParts& parts, std::optional<ArmId> arm, SpeedShare asked,
               const Respond& respond, Answer answer) {
  ask_urgently(
      parts,
      [arm, asked, answer](Executive& executive) {
        executive.set_speed(arm, asked.share);
        return answer(executive);
      },
      [&parts, arm, asked, respond](const Response& response) {
        if (parts.keeper == nullptr) return respond(response);
        parts.keeper->set_speed(arm ? parts.cell->arm(*arm).name : "", asked,
                                when_stored(respond, response));
      });
}

void put_speed(Call call) {
  const auto set = [&parts = call.parts, respond = call.respond](const SpeedShare& asked) {
    set_speed(parts, std::nullopt, asked, respond,
              [asked](const Executive&) { return answer(200, speed_override_format(), asked); });
  };
  read_body(call.parts, call.request, call.respond, read_speed_override, set);
}
void put_arm_speed(Call call) {
  const auto set = [&parts = call.parts, name = call.arguments.front(),
                    respond = call.respond](const SpeedShare& asked) {
    const auto arm = parts.cell->find_arm(name);
    if (!arm) return respond(no_such_arm(parts, name));
    set_speed(parts, *arm, asked, respond, [arm = *arm](const Executive& executive) {
      return answer(200, arm_speed_format(), executive.arms()[arm.index()]);
    });
  };
  read_body(call.parts, call.request, call.respond, read_speed_override, set);
}

std::vector<Route> speed_routes() {
  const auto route = [](const char* method, const char* path, const char* id, const char* summary) {
    return Route{.method = method,
                 .path = api_path(path),
                 .id = id,
                 .tag = "arms",
                 .summary = summary,
                 .as_text = speed_text};
  };
  const auto setting = [&](const char* path, const char* id, const char* summary) {
    Route put = route("PUT", path, id, summary);
    put.text =
        "Applies at once, also in motion: the speed changes within the joints' limits. At 0 the "
        "arms come to rest on their paths, and their jobs wait for kind `speed`. Passing orders "
        "and certificates hold at any override. Timeouts and aging count at the smallest override "
        "of all arms. This is no safety function: an override of 0 is not a stop.";
    put.reads = body(speed_override_format(), {{"quarter", R"({"speed_override": 0.25})"}});
    put.refuses = {422, 507};
    put.who = Who::commander;
    put.role = Role::operate;
    return put;
  };
  Route get = route("GET", "/speed", "getSpeedOverride", "Get the speed override of the cell");
  get.outcomes = {outcome(200, "The speed override of the cell", speed_override_format())};
  get.run = get_speed;
  Route put = setting("/speed", "setSpeedOverride", "Set the speed override of the cell");
  put.outcomes = {outcome(200, "The override that now applies", speed_override_format())};
  put.run = put_speed;
  Route get_one =
      route("GET", "/arms/{name}/speed", "getArmSpeedOverride", "Get the speed override of an arm");
  get_one.outcomes = {outcome(200, "The speed override of the arm", arm_speed_format())};
  get_one.refuses = {404};
  get_one.run = get_arm_speed;
  Route put_one =
      setting("/arms/{name}/speed", "setArmSpeedOverride", "Set the speed override of an arm");
  put_one.outcomes = {outcome(200, "The override that now applies", arm_speed_format())};
  put_one.refuses = {404, 422, 507};
  put_one.run = put_arm_speed;
  return {get, put, get_one, put_one};
}

Route command(const char* path, const char* id, const char* summary) {
  return {.method = "POST",
          .path = api_path(path),
          .id = id,
          .tag = "arms",
          .summary = summary,
          .who = Who::commander,
          .role = Role::operate};
}

}  // namespace

std::vector<Route> arm_routes() {
  const std::string as_category =
      "as its category says (2 and 1: on the path; 0: each joint brakes by itself, drives off, and "
      "a moving arm leaves its path)";
  const char* const category_in_query =
      "the stop category is a query parameter, for example ?category=0";
  const char* const faulty_stop =
      "A faulty request (an unknown or repeated parameter, a bad value, a body) is answered 400, "
      "and "
      "stops with category 2.";
  Route stop_one = command("/arms/{name}/stop", "stopArm", "Stop one arm");
  stop_one.outcomes = {
      outcome(202, "The arm stops " + as_category + ", and stays stopped", arm_format())};
  stop_one.refuses = {404};
  stop_one.parameters = stop_query().parameters();
  stop_one.instead_of_body = category_in_query;
  stop_one.text = faulty_stop;
  stop_one.is_stop = true;
  stop_one.as_text = arm_text;
  stop_one.run = stop_arm;
  Route resume_one = command("/arms/{name}/resume", "resumeArm", "Resume one arm");
  resume_one.outcomes = {outcome(
      202, "The arm is resumed; its job continues as soon as its path is certified collision-free",
      arm_format())};
  resume_one.refuses = {404, 409};
  resume_one.as_text = arm_text;
  resume_one.run = resume_arm;
  Route stop = command("/stop", "stopAll", "Stop every arm");
  stop.outcomes = {
      outcome(202, "All arms stop " + as_category + ", and stay stopped", stopped_format())};
  stop.parameters = stop_query().parameters();
  stop.instead_of_body = category_in_query;
  stop.text = faulty_stop;
  stop.is_stop = true;
  stop.as_text = stopped_text;
  stop.run = stop_all;
  Route resume = command("/resume", "resumeAll", "Resume all arms");
  resume.outcomes = {outcome(
      202,
      "All arms are resumed; jobs continue as soon as their paths are certified collision-free",
      stopped_format())};
  resume.instead_of_body = "to resume one arm: POST /api/v1/arms/{name}/resume";
  resume.as_text = stopped_text;
  resume.run = resume_all;
  std::vector<Route> routes{
      {.method = "GET",
       .path = api_path("/arms"),
       .id = "listArms",
       .tag = "arms",
       .summary = "List all arms",
       .outcomes = {outcome(200, "All arms with their measured positions", arm_list_format())},
       .as_text = arm_list_text,
       .run = list_arms},
      {.method = "GET",
       .path = api_path("/arms/{name}"),
       .id = "getArm",
       .tag = "arms",
       .summary = "Get one arm",
       .outcomes = {outcome(200, "The arm with its measured position", arm_format())},
       .refuses = {404},
       .as_text = arm_text,
       .run = get_arm},
      stop_one,
      resume_one,
      stop,
      resume,
  };
  std::ranges::move(speed_routes(), std::back_inserter(routes));
  return routes;
}

}  // namespace armloom
