#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "server/api/route.h"
#include "server/messages/events.h"

namespace armloom {
namespace {

constexpr std::size_t kSnapshotEnded = 200;  // ended jobs that a new subscriber is told

// What no reader of events can mean.
std::optional<Refusal> query_fault(const Target& target) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto bad = [](const std::string& name, const std::string& value, const char* rule) {
    return Refusal{400, "bad-parameter", std::string(rule) + ", found \"" + value + "\"",
                   "?" + name, value};
  };
  const auto since = target.parameter("since");
  if (since && (since->empty() || !std::ranges::all_of(*since, is_digit))) {
    return bad("since", *since, "since is the number of an event");
  }
  const auto poses = target.parameter("poses");
  if (poses && *poses != "0" && *poses != "1") return bad("poses", *poses, "poses is 0 or 1");
  return std::nullopt;
}

// Where a reader was.
struct StreamPlace {
  std::optional<std::string> stream;
  std::optional<std::string> since;
};
// A `Last-Event-ID: <stream>:<seq>` is newer than what the address says: a browser repeats the
// address when it comes back.
StreamPlace place_of(const Request& request) {
  if (!request.last_event_id) {
    return {request.target.parameter("stream"), request.target.parameter("since")};
  }
  const std::string& id = *request.last_event_id;
  const std::size_t colon = id.rfind(':');
  return {id.substr(0, colon), colon == id.npos ? "" : id.substr(colon + 1)};
}

// All who wait begin with this snapshot, which is written once.
void welcome(const ApiParts& parts, const Snapshot& snapshot) {
  std::array<Hub::Text, 2> texts;  // without and with a gap
  for (const ApiParts::Newcomer& newcomer : std::exchange(*parts.newcomers, {})) {
    Hub::Text& text = texts[newcomer.gap ? 1 : 0];
    if (!text) {
      text = std::make_shared<const std::string>(
          snapshot_json({&snapshot, parts.cell.get(), parts.loop.speed(), newcomer.gap},
                        parts.stream, parts.clock));
    }
    if (SubscriptionPtr subscription = parts.hub.resume(snapshot.seq, text))
      newcomer.then(std::move(subscription));
  }
}

// Calls then(subscription). It resumes where the reader was; otherwise, and when those events are
// gone
// ("gap"), it begins with a snapshot.
void subscribe(const ApiParts& parts, const StreamPlace& place,
               std::function<void(SubscriptionPtr)> then) {
  if (place.since) {
    std::uint64_t seq = 0;
    const char* end = place.since->data() + place.since->size();
    const auto [stop, ec] = std::from_chars(place.since->data(), end, seq);
    const bool read = ec == std::errc{} && stop == end;
    if (read && place.stream == parts.stream) {
      if (SubscriptionPtr subscription = parts.hub.resume(seq))
        return then(std::move(subscription));
    }
  }
  parts.newcomers->push_back({place.since.has_value(), std::move(then)});
  if (parts.newcomers->size() > 1) return;
  // Every event up to the snapshot's seq was posted to this thread before the snapshot, and every
  // later one comes after it: what follows seq in the hub is exactly what the snapshot lacks.
  ask(
      parts, [](Executive& executive) { return executive.snapshot(kSnapshotEnded); },
      [&parts](const Snapshot& snapshot) { welcome(parts, snapshot); });
}

void stream(Call& call, int status, bool frames) {
  if (const auto fault = query_fault(call.request.target)) {
    return call.respond(refusal_response(*fault));
  }
  subscribe(call.parts, place_of(call.request),
            [&parts = call.parts, status, frames, token = call.request.token,
             respond = call.respond](SubscriptionPtr subscription) {
              Response response{status, "text/event-stream", "", {{"Cache-Control", "no-store"}}};
              response.events = EventStream{std::move(subscription), parts.stream, frames};
              if (parts.guard.asks()) {
                response.events->permitted = [&parts, token] {
                  return parts.guard.caller(token).has_value();
                };
              }
              respond(std::move(response));
            });
}

void get_events(Call call) { stream(call, 200, call.request.target.parameter("poses") == "1"); }

void open_socket(Call call) {
  if (call.request.upgrade) return stream(call, 101, true);
  if (const auto fault = query_fault(call.request.target)) {
    return call.respond(refusal_response(*fault));
  }
  call.respond(refusal_response({426,
                                 "upgrade-required",
                                 "this is a WebSocket",
                                 std::nullopt,
                                 std::nullopt,
                                 {{"Upgrade", "websocket"}}}));
}

std::vector<Parameter> resume_parameters() {
  return {{"stream", "With since: resume there", {{"type", "string"}}},
          {"since", "The last seq that was seen", {{"type", "string"}, {"pattern", "^[0-9]+$"}}}};
}

}  // namespace

std::vector<Route> event_routes() {
  Route events{.method = "GET",
               .path = api_path("/events"),
               .id = "streamEvents",
               .tag = "events",
               .summary = "Events as Server-Sent Events",
               .text = "Too old, or of another run: a new snapshot with \"gap\": true.",
               .parameters = resume_parameters(),
               .run = get_events};
  events.parameters.push_back(
      {"poses", "1: state frames too", {{"type", "string"}, {"enum", {"0", "1"}}}});
  events.parameters.push_back(
      {"Last-Event-ID", "<stream>:<seq>: resume there", {{"type", "string"}}, false, "header"});
  events.outcomes = {{200,
                      "Each event: `id: <stream>:<seq>`, `data: <envelope>`. A snapshot first, "
                      "unless the reader resumes; a comment every 15 s.",
                      {{"text/event-stream", message_schema()}}}};

  Route socket{.method = "GET",
               .path = api_path("/ws"),
               .id = "openWebSocket",
               .tag = "events",
               .summary = "Events and poses on a WebSocket",
               .parameters = resume_parameters(),
               .refuses = {426},
               .who = Who::commander,
               .run = open_socket};
  socket.outcomes = {{101,
                      "The same envelopes as `/events`, one in each text message (schema Message), "
                      "and state frames."}};
  return {events, socket};
}

}  // namespace armloom
