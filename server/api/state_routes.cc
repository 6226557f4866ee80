// GET /states. An answer can have a hundred thousand numbers, so it is written on a worker thread.
#include <memory>

#include "server/api/route.h"
#include "server/messages/measured_states.h"

namespace armloom {
namespace {

void get_states(Call call) {
  const ApiParts& parts = call.parts;
  parts.aside([&parts, frames = parts.states.frames(), respond = std::move(call.respond)] {
    MeasuredStates states{.stream = parts.stream, .joints = {}, .times = {}, .q = {}};
    for (const Joint& joint : parts.cell->joints) states.joints.push_back(joint.name);
    for (const RecentStates::FramePtr& frame : frames) {
      states.times.push_back(frame->time);
      states.q.push_back(frame->q);
    }
    parts.post(
        [response = std::make_shared<Response>(answer(200, measured_states_format(), states)),
         respond] { respond(std::move(*response)); });
  });
}

}  // namespace

std::vector<Route> state_routes() {
  Route get{.method = "GET",
            .path = api_path("/states"),
            .id = "listStates",
            .tag = "arms",
            .summary = "Get the measured joint positions of the last five minutes"};
  get.text =
      "Returns ten samples per second of wall time, for clients that connect later. Later "
      "positions arrive as events of type `state` at 30 Hz. Recordings made with `--record` "
      "contain all states at 1 kHz.";
  get.outcomes = {outcome(200, "Samples of the last five minutes", measured_states_format())};
  get.run = get_states;
  return {get};
}

}  // namespace armloom
