#include <charconv>
#include <chrono>
#include <utility>

#include "server/api/routes.h"
#include "server/codec/fault_codec.h"
#include "server/codec/json_writer.h"

namespace armloom {
namespace {

using Arguments = Router::Arguments;

// The speed changes on the strand, where cell time and wall time are known together.
void put_speed(const ApiParts& parts, const Request& request, Respond respond) {
  const auto speed = read_body(request, read_speed_text);
  if (!speed) return respond(problem_response(speed.error()));
  struct Change {
    TimePoint time;
    WallClock::Wall wall;
  };
  ask(
      parts,
      [&parts, speed = *speed](Executive& executive) {
        parts.loop.set_speed(speed);
        return Change{executive.now(), std::chrono::system_clock::now()};
      },
      [&parts, respond, speed = *speed](const Change& change) {
        parts.clock.anchor(change.time, change.wall, speed);
        JsonWriter out;
        out.begin_object().field("speed", speed).end_object();
        respond(json_response(200, out.take()));
      });
}

void post_fault(const ApiParts& parts, const Request& request, Respond respond) {
  const auto read = read_body(request, read_fault_text);
  if (!read) return respond(problem_response(read.error()));
  ask(
      parts, [fault = *read](Executive& executive) { return executive.inject(fault); },
      [respond, fault = *read](const Result<std::uint64_t>& id) {
        if (!id) return respond(problem_response(id.error()));
        Response response = json_response(201, fault_json(*id, fault));
        response.headers.emplace_back("Location", "/api/v1/sim/faults/" + std::to_string(*id));
        respond(std::move(response));
      });
}

void delete_fault(const ApiParts& parts, const std::string& name, Respond respond) {
  std::uint64_t id = 0;
  const char* end = name.data() + name.size();
  const auto [stop, ec] = std::from_chars(name.data(), end, id);
  if (ec != std::errc{} || stop != end) return respond(no_such("fault", name));
  ask(
      parts, [id](Executive& executive) { return executive.remove_fault(id); },
      [respond, name](const Result<void>& removed) {
        respond(removed ? Response{204, "", "", {}} : no_such("fault", name));
      });
}

}  // namespace

void add_simulation_routes(Router& router, const ApiParts& parts) {
  const std::string sim = kApi + std::string("/sim");
  router.add("PUT", sim + "/speed",
             [&parts](const Request& request, const Arguments&, Respond respond) {
               put_speed(parts, request, std::move(respond));
             });
  router.add("POST", sim + "/faults",
             [&parts](const Request& request, const Arguments&, Respond respond) {
               post_fault(parts, request, std::move(respond));
             });
  router.add("DELETE", sim + "/faults/{}",
             [&parts](const Request&, const Arguments& arguments, Respond respond) {
               delete_fault(parts, arguments.front(), std::move(respond));
             });
}

}  // namespace armloom
