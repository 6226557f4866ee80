#include <utility>

#include "core/executive/status_board.h"
#include "server/api/route.h"
#include "server/messages/signal.h"

namespace armloom {
namespace {

void get_io(Call call) {
  call.respond(answer(200, signal_list_format(), {*call.parts.loop.board().read().signals}));
}

void put_signal(Call call) {
  const auto set = [&parts = call.parts, respond = call.respond,
                    name = call.arguments.front()](const SignalRequest& request) {
    ask(
        parts,
        [name, request](Executive& executive) {
          return executive.signals().set(name, request.value);
        },
        [respond](const Result<SignalView>& signal) {
          respond(signal ? answer(200, signal_format(), *signal)
                         : problem_response(signal.error()));
        });
  };
  read_body(call.parts, call.request, call.respond, read_signal_request, set);
}

}  // namespace

std::vector<Route> io_routes() {
  return {
      {.method = "GET",
       .path = api_path("/io"),
       .id = "getIo",
       .tag = "io",
       .summary = "Get all inputs and outputs",
       .outcomes = {outcome(200, "The inputs and outputs of the cell file", signal_list_format())},
       .run = get_io},
      {.method = "PUT",
       .path = api_path("/io/{name}"),
       .id = "putSignal",
       .tag = "io",
       .summary = "Set an output, or a simulated input",
       .text = "An output of a device has the new value when the device reports it; until then the "
               "answer has it as `commanded`. 409 for an input of a device; 503 if the device is "
               "not connected.",
       .reads = body(signal_request_format(),
                     {{"switch", R"({"value": true})"}, {"register", R"({"value": 250})"}}),
       .outcomes = {outcome(200, "The signal", signal_format())},
       .refuses = {404, 409, 422, 503},
       .who = Who::commander,
       .role = Role::operate,
       .run = put_signal},
  };
}

}  // namespace armloom
