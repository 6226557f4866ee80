#include <algorithm>
#include <charconv>
#include <utility>

#include "core/executive/status_board.h"
#include "server/api/listings.h"
#include "server/api/query_format.h"
#include "server/api/route.h"
#include "server/messages/events.h"

namespace armloom {
namespace {

constexpr std::size_t kSnapshotEnded = 200;  // ended jobs in a snapshot

struct StreamQuery {
  std::optional<std::string> stream;
  std::optional<std::string> since;
  bool poses = false;
};
std::vector<QueryPart<StreamQuery>> resume_parts() {
  using Query = StreamQuery;
  const auto number = [](const std::string& value, Query& out) {
    out.since = value;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    const bool is_read = !value.empty() && std::ranges::all_of(value, is_digit);
    return is_read ? std::nullopt
                   : std::optional("since must be the seq of an event, found \"" + value + "\"");
  };
  return {query::text<Query>("stream", &Query::stream, "With `since`: the stream to resume"),
          {{"since",
            "The last seq that the subscriber has received",
            {{"type", "string"}, {"pattern", "^[0-9]+$"}}},
           number}};
}
const QueryFormat<StreamQuery>& socket_query() {
  static const QueryFormat<StreamQuery> format(resume_parts(), ProblemKind::malformed);
  return format;
}
const QueryFormat<StreamQuery>& events_query() {
  static const QueryFormat<StreamQuery> format = [] {
    auto parts = resume_parts();
    parts.push_back(query::flag("poses", &StreamQuery::poses, "1: send state frames, too"));
    return QueryFormat<StreamQuery>(std::move(parts), ProblemKind::malformed);
  }();
  return format;
}

// Returns the position at which the client resumes the stream. The header `Last-Event-ID:
// <stream>:<seq>` takes precedence over the query, because a reconnecting browser repeats the
// original query.
StreamQuery place_of(const Request& request, StreamQuery asked) {
  if (!request.last_event_id) return asked;
  const std::string& id = *request.last_event_id;
  const std::size_t colon = id.rfind(':');
  asked.stream = id.substr(0, colon);
  asked.since = colon == id.npos ? "" : id.substr(colon + 1);
  return asked;
}

std::string snapshot_text(const ApiParts& parts, const Status& status, const WallClock& clock,
                          bool gap, JobTexts& texts) {
  const std::vector<ListedJob> jobs = texts.of(status.jobs_with_ended(kSnapshotEnded), clock);
  const Snapshot snapshot = snapshot_of(status, *parts.cell);
  return snapshot_json({&snapshot, &jobs, parts.cell.get(), parts.loop.speed(), gap}, parts.stream,
                       clock);
}

void write_snapshot(const ApiParts& parts);

// Subscribes newcomers (subscribers that wait for a snapshot). `text` is the snapshot; `seq` is its
// last event. All events up to `seq` reached this thread before the text, so the hub continues
// after `seq` without a gap. If the hub has already dropped later events, the newcomers wait for
// the next snapshot.
void welcome(const ApiParts& parts, const std::vector<ApiParts::Newcomer>& newcomers,
             std::uint64_t seq, const Hub::Text& text) {
  for (const ApiParts::Newcomer& newcomer : newcomers) {
    if (SubscriptionPtr subscription = parts.hub.resume(seq, text)) {
      newcomer.then(std::move(subscription));
    } else {
      parts.newcomers->waiting.push_back(newcomer);
    }
  }
  parts.newcomers->is_one_written = false;
  if (!parts.newcomers->waiting.empty()) write_snapshot(parts);
}

// Writes one snapshot, for the first newcomer and all others with the same `gap`.
void write_snapshot(const ApiParts& parts) {
  parts.newcomers->is_one_written = true;
  std::vector<ApiParts::Newcomer>& waiting = parts.newcomers->waiting;
  const bool gap = waiting.front().gap;
  const auto others = std::stable_partition(waiting.begin(), waiting.end(),
                                            [gap](const auto& one) { return one.gap == gap; });
  std::vector<ApiParts::Newcomer> newcomers(waiting.begin(), others);
  waiting.erase(waiting.begin(), others);
  const auto status = std::make_shared<const Status>(parts.loop.board().read());
  parts.listings.write(
      [&parts, status, gap, clock = parts.clock](JobTexts& texts) {
        return snapshot_text(parts, *status, clock, gap, texts);
      },
      [&parts, newcomers = std::move(newcomers), seq = status->seq](std::string text) {
        welcome(parts, newcomers, seq, std::make_shared<const std::string>(std::move(text)));
      });
}

// Resumes after `place` if all later events are still kept, else begins with a snapshot. If `place`
// was given, the snapshot has `"gap": true`.
void subscribe(const ApiParts& parts, const StreamQuery& place,
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
  parts.newcomers->waiting.push_back({place.since.has_value(), std::move(then)});
  if (!parts.newcomers->is_one_written) write_snapshot(parts);
}

void stream(Call& call, int status, bool frames, StreamQuery asked) {
  subscribe(call.parts, place_of(call.request, std::move(asked)),
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

void get_events(Call call) {
  auto asked = events_query().read(call.request.target);
  if (!asked) return call.respond(problem_response(asked.error()));
  const bool frames = asked->poses;
  stream(call, 200, frames, *std::move(asked));
}

void open_socket(Call call) {
  auto asked = socket_query().read(call.request.target);
  if (!asked) return call.respond(problem_response(asked.error()));
  if (call.request.upgrade) return stream(call, 101, true, *std::move(asked));
  call.respond(refusal_response({426,
                                 "upgrade-required",
                                 "this address serves WebSocket only: send an upgrade request",
                                 std::nullopt,
                                 std::nullopt,
                                 {{"Upgrade", "websocket"}}}));
}

}  // namespace

std::vector<Route> event_routes() {
  Route events{.method = "GET",
               .path = api_path("/events"),
               .id = "streamEvents",
               .tag = "events",
               .summary = "Subscribe to events as Server-Sent Events",
               .text =
                   "A subscriber resumes with `Last-Event-ID`, or with `stream` and `since`. If "
                   "the following events are no longer kept, or the stream belongs to another "
                   "session, a new snapshot with `\"gap\": true` is sent.",
               .parameters = events_query().parameters(),
               .run = get_events};
  events.parameters.push_back(
      {"Last-Event-ID",
       "`<stream>:<seq>` of the last event received; the stream resumes after this event",
       {{"type", "string"}},
       false,
       "header"});
  events.outcomes = {
      {200,
       "Each event has `id: <stream>:<seq>` and `data: <envelope>`. The stream begins with a "
       "snapshot unless it is resumed. A comment line is sent after 15 s without events.",
       {{"text/event-stream", message_schema()}}}};

  Route socket{.method = "GET",
               .path = api_path("/ws"),
               .id = "openWebSocket",
               .tag = "events",
               .summary = "Subscribe to events and state frames over WebSocket",
               .parameters = socket_query().parameters(),
               .refuses = {426},
               .who = Who::commander,
               .run = open_socket};
  socket.outcomes = {
      {101, "One envelope per text message (schema Message), as on `/events`, and state frames."}};
  return {events, socket};
}

}  // namespace armloom
