#include "server/api/api.h"

#include <charconv>
#include <utility>

#include "server/api/routes.h"
#include "server/codec/cell_codec.h"
#include "server/codec/mesh_address.h"
#include "server/codec/views.h"
#include "server/openapi/openapi.h"

namespace armloom {
namespace {

constexpr std::size_t kSnapshotEnded = 200;  // ended jobs that a new subscriber is told

}  // namespace

void Api::add_routes(Router& router) {
  using Arguments = Router::Arguments;
  const std::string api = kApi;
  add_submission_routes(router, parts_);
  add_job_routes(router, parts_);
  add_arm_routes(router, parts_);
  add_scene_routes(router, parts_);
  add_simulation_routes(router, parts_);
  add_openapi_routes(router);
  router.add("GET", api + "/cell", [this](const Request&, const Arguments&, Respond respond) {
    respond(json_response(200, cell_json(*parts_.cell, parts_.policy, parts_.loop.speed())));
  });
  router.add("GET", kMeshFolder + std::string("{}"),
             [this](const Request&, const Arguments& a, Respond respond) {
               respond(meshes_.answer(a.front()));
             });
  // A GET is answered by the connection itself, for as long as it lasts: this is for HEAD and 405.
  router.add("GET", api + "/events",
             [](const Request&, const Arguments&, Respond respond) {
               respond(Response{200, "text/event-stream", "", {{"Cache-Control", "no-store"}}});
             },
             {"stream", "since", "poses"});
  // The same: handshakes do not come here.
  router.add("GET", api + "/ws",
             [](const Request&, const Arguments&, Respond respond) {
               Response refused = http_problem(426, "upgrade-required", "this is a WebSocket");
               refused.headers.emplace_back("Upgrade", "websocket");
               respond(std::move(refused));
             },
             {"stream", "since"});
  router.add("GET", "/healthz", [](const Request&, const Arguments&, Respond respond) {
    respond(json_response(200, R"({"status":"ok"})"));
  });
  router.add("GET", "/readyz", [this](const Request&, const Arguments&, Respond respond) {
    ask(
        parts_, [](Executive& executive) { return executive.now(); },
        [respond](TimePoint now) {
          JsonWriter out;
          out.begin_object().field("ready", true).field("t_s", now).end_object();
          respond(json_response(200, out.take()));
        });
  });
}

void Api::subscribe(const Target& target, std::function<void(FeedPtr)> then) {
  bool gap = false;
  if (const auto since = target.parameter("since")) {
    std::uint64_t seq = 0;
    const char* end = since->data() + since->size();
    const auto [stop, ec] = std::from_chars(since->data(), end, seq);
    const bool read = ec == std::errc{} && stop == end;
    if (read && target.parameter("stream") == parts_.stream) {
      if (FeedPtr feed = parts_.hub.resume(seq)) return then(std::move(feed));
    }
    gap = true;
  }
  // Every event up to the snapshot's seq was posted to this thread before the snapshot, and every
  // later one comes after it: what follows seq in the hub is exactly what the snapshot lacks.
  ask(
      parts_, [](Executive& executive) { return executive.snapshot(kSnapshotEnded); },
      [this, gap, then](const Snapshot& snapshot) {
        const auto text = std::make_shared<const std::string>(snapshot_json(
            snapshot, *parts_.cell, parts_.stream, parts_.loop.speed(), parts_.clock, gap));
        if (FeedPtr feed = parts_.hub.resume(snapshot.seq, text)) then(std::move(feed));
      });
}

}  // namespace armloom
