// GET /states. An answer can have a hundred thousand numbers, so it is written on a worker thread.
#include <chrono>
#include <memory>

#include "server/api/query_format.h"
#include "server/api/route.h"
#include "server/messages/measured_states.h"

namespace armloom {
namespace {

constexpr double kWaitMax_s = 30.0;

struct StatesQuery {
  std::optional<std::string> stream = {};
  std::optional<double> after_s = {};
  double wait_s = 0.0;
};
const QueryFormat<StatesQuery>& states_query() {
  using Query = StatesQuery;
  static const QueryFormat<Query> format(
      {query::number<Query>("after_s", &Query::after_s, 0.0, 1e9,
                            "Only samples after this cell time: the last of `t_s` that the client "
                            "has received"),
       query::number<Query>(
           "wait_s", &Query::wait_s, 0.0, kWaitMax_s,
           "With `after_s`: if there is no such sample yet, wait for the next one, "
           "at most this long; default 0"),
       query::text<Query>("stream", &Query::stream,
                          "With `after_s`: the session that the client has samples of. If it is "
                          "another one, all samples are returned")},
      ProblemKind::malformed);
  return format;
}

void tell(const ApiParts& parts, const std::vector<RecentStates::FramePtr>& frames,
          const Respond& respond) {
  parts.aside([&parts, frames, respond] {
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

void get_states(Call call) {
  const auto query = states_query().read(call.request.target);
  if (!query) return call.respond(problem_response(query.error()));
  const ApiParts& parts = call.parts;
  const auto then = [&parts,
                     respond = call.respond](const std::vector<RecentStates::FramePtr>& frames) {
    tell(parts, frames, respond);
  };
  const bool is_known = !query->stream || *query->stream == parts.stream;
  if (!query->after_s || !is_known) {
    return then({parts.states.frames().begin(), parts.states.frames().end()});
  }
  const TimePoint after(from_seconds(*query->after_s));
  const std::chrono::duration<double> wait(query->wait_s);
  if (query->wait_s > 0.0) {
    const auto deadline = RecentStates::Clock::now() +
                          std::chrono::duration_cast<RecentStates::Clock::duration>(wait);
    return parts.states.when_later(after, deadline, then);
  }
  then(parts.states.later_than(after));
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
      "contain all states at 1 kHz. For long polling, repeat `?after_s=T&wait_s=30` with the last "
      "of `t_s`: each answer has only the samples that are new.";
  get.parameters = states_query().parameters();
  get.outcomes = {outcome(200, "Samples of the last five minutes", measured_states_format())};
  get.run = get_states;
  return {get};
}

}  // namespace armloom
