#include <charconv>
#include <chrono>
#include <utility>

#include "server/api/route.h"
#include "server/drivers/remote_controller.h"
#include "server/messages/fault.h"
#include "server/messages/plain_text.h"

namespace armloom {
namespace {

// Changes the speed on the executive's strand, because cell time and wall time of the change are
// known together only there.
void put_speed(Call call) {
  struct Change {
    TimePoint time;
    WallClock::Wall wall;
  };
  const ApiParts& parts = call.parts;
  const auto set = [&parts, respond = call.respond](const auto& speed) {
    const auto remote = remote_robots(*parts.cell);
    if (speed.speed != 1.0 && !remote.empty()) {
      return respond(problem_response(
          {Problem{ProblemKind::invalid, "speed-of-remote-robot", "/speed",
                   "robot " + remote.front() + " has a remote controller, which runs in real time",
                   speed.speed}}));
    }
    ask(
        parts,
        [&parts, speed](Executive& executive) {
          parts.loop.set_speed(speed.speed);
          parts.metrics.set_speed(speed.speed);
          return Change{executive.now(), std::chrono::system_clock::now()};
        },
        [&parts, respond, speed](const Change& change) {
          parts.clock.anchor(change.time, change.wall, speed.speed);
          respond(answer(200, speed_format(), speed));
        });
  };
  read_body(
      parts, call.request, call.respond,
      [](std::string_view text) { return read_text(*speed_format(), text); }, set);
}

void post_fault(Call call) {
  const auto inject = [&parts = call.parts, respond = call.respond](const auto& fault) {
    ask(
        parts, [fault](Executive& executive) { return executive.faults().inject(fault); },
        [respond, fault](const Result<std::uint64_t>& id) {
          if (!id) return respond(problem_response(id.error()));
          respond(located(answer(201, fault_format(), {*id, fault}),
                          "/sim/faults/" + std::to_string(*id)));
        });
  };
  read_body(call.parts, call.request, call.respond, read_fault_text, inject);
}

void list_faults(Call call) {
  ask(
      call.parts,
      [&targets = call.parts.faults](Executive& executive) {
        return targets.list(executive.now());
      },
      [respond = call.respond](const FaultListing& listing) {
        respond(answer(200, fault_list_format(), listing));
      });
}

void delete_fault(Call call) {
  const std::string& name = call.arguments.front();
  std::uint64_t id = 0;
  const char* end = name.data() + name.size();
  const auto [stop, ec] = std::from_chars(name.data(), end, id);
  if (ec != std::errc{} || stop != end) return call.respond(no_such("fault", name));
  ask(
      call.parts, [id](Executive& executive) { return executive.faults().remove(id); },
      [respond = call.respond, name](const Result<void>& removed) {
        respond(removed ? Response{204, ""} : no_such("fault", name));
      });
}

}  // namespace

std::vector<Route> simulation_routes() {
  return {
      {.method = "PUT",
       .path = api_path("/sim/speed"),
       .id = "setSpeed",
       .tag = "simulation",
       .summary = "Set the speed of cell time",
       .reads = body(speed_format(), {{"double", R"({"speed": 2.0})"}}),
       .outcomes = {outcome(200, "The new speed applies from the next control cycle on",
                            speed_format())},
       .refuses = {422},
       .who = Who::commander,
       .role = Role::operate,
       .run = put_speed},
      {.method = "GET",
       .path = api_path("/sim/faults"),
       .id = "listFaults",
       .tag = "simulation",
       .summary = "List the faults of simulated arms",
       .outcomes = {outcome(200, "All faults that are not over, also those that have not begun",
                            fault_list_format())},
       .as_text = fault_list_text,
       .run = list_faults},
      {.method = "POST",
       .path = api_path("/sim/faults"),
       .id = "injectFault",
       .tag = "simulation",
       .summary = "Inject a fault into a simulated arm",
       .reads = body(fault_request_format(),
                     {{"slow", R"({"arm": "left", "kind": "slow", "value": 0.5, "for_s": 2})"}}),
       .outcomes = {created(201, "The fault is injected", fault_format())},
       .refuses = {422},
       .who = Who::commander,
       .role = Role::operate,
       .as_text = fault_text,
       .run = post_fault},
      {.method = "DELETE",
       .path = api_path("/sim/faults/{id}"),
       .id = "removeFault",
       .tag = "simulation",
       .summary = "Remove a fault",
       .outcomes = {{204, "The fault is removed"}},
       .refuses = {404},
       .who = Who::commander,
       .role = Role::operate,
       .run = delete_fault},
  };
}

}  // namespace armloom
