#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/api/cell_meshes.h"
#include "server/api/parts.h"
#include "server/api/recording_files.h"
#include "server/http/router.h"

namespace armloom {

// One call of a verb: what it works with, what was asked, whom to answer. `parts`, `meshes` and
// `recordings` outlive every answer; the request is only valid during the call.
struct Call {
  const ApiParts& parts;
  CellMeshes& meshes;
  const RecordingFiles& recordings;
  const Request& request;
  const Router::Arguments& arguments;  // what stood in the path for {id}
  Respond respond;
};

// A parameter of the query, or a header field that the verb reads.
struct Parameter {
  std::string name;
  std::string text;
  Schema schema;
  bool required = false;
  const char* in = "query";
};

struct Body {
  Schema schema;
  std::vector<std::pair<std::string, std::string>> examples;  // name, JSON; each is accepted
};

struct Content {
  std::string type;
  Schema schema;
};
struct Outcome {
  int status;
  std::string text;
  std::vector<Content> content = {};
  bool has_location = false;
  bool has_tag = false;  // ETag
};

// A verb of the interface: the one description from which come dispatch, `Allow`, and its place in
// /openapi.json. A new verb is one of these, and its function.
struct Route {
  std::string method;
  std::string path;  // whole, with {id} where anything may stand
  std::string id;    // operationId
  std::string tag;
  std::string summary;
  std::string text = "";  // empty: the summary says it all
  std::vector<Parameter> parameters = {};
  std::optional<Body> reads = {};
  std::vector<Outcome> outcomes;
  std::vector<int> refuses = {};  // beside what common_refusals() has
  Who who = Who::reader;
  std::optional<Role> role = Role::viewer;  // none: no token is needed
  bool is_never_limited = false;            // whatever else its client asks for (ClientLimits)
  void (*run)(Call call);  // null: the dashboard's files, which the router leaves to others

  [[nodiscard]] Rights rights() const { return {who, role, is_never_limited}; }
};

// The routes by resource. All of them, in the order in which they are tried.
[[nodiscard]] std::vector<Route> job_routes();         // /jobs, /queue, /timeline
[[nodiscard]] std::vector<Route> motion_routes();      // /jobs/{id}/trajectory
[[nodiscard]] std::vector<Route> submission_routes();  // POST /jobs, /batches, /check
[[nodiscard]] Route batch_route();
[[nodiscard]] Route amend_route();
[[nodiscard]] std::vector<Route> plan_routes();        // /plan
[[nodiscard]] std::vector<Route> arm_routes();         // /arms, /stop, /resume
[[nodiscard]] std::vector<Route> control_routes();     // /control, holding to run
[[nodiscard]] std::vector<Route> scene_routes();       // /scene
[[nodiscard]] std::vector<Route> cell_routes();        // /cell and its meshes
[[nodiscard]] std::vector<Route> comparison_routes();  // /comparison
[[nodiscard]] std::vector<Route> simulation_routes();  // /sim
[[nodiscard]] std::vector<Route> event_routes();       // /events, /ws
[[nodiscard]] std::vector<Route> alert_routes();       // /alerts
[[nodiscard]] std::vector<Route> audit_routes();       // /audit-log
[[nodiscard]] std::vector<Route> state_routes();       // /states
[[nodiscard]] std::vector<Route> recording_routes();   // /recordings
[[nodiscard]] std::vector<Route> session_routes();     // /session, /login
[[nodiscard]] std::vector<Route> service_routes();     // /healthz, /docs, ...
[[nodiscard]] const std::vector<Route>& all_routes();

// What every verb may answer when a request cannot be served, and what comes to that with a body
// (415) and with a command (403).
[[nodiscard]] std::vector<int> common_refusals(const Route& route);

// "/jobs" as it is called.
[[nodiscard]] std::string api_path(const std::string& path);

// What a verb reads and what it answers, by their formats.
template <class T>
[[nodiscard]] Body body(const FormatPtr<T>& format,
                        std::vector<std::pair<std::string, std::string>> examples) {
  return {format->schema(Way::in), std::move(examples)};
}
template <class T>
[[nodiscard]] Outcome outcome(int status, std::string text, const FormatPtr<T>& format) {
  return {status, std::move(text), {{"application/json", format->schema(Way::out)}}};
}
template <class T>
[[nodiscard]] Outcome created(int status, std::string text, const FormatPtr<T>& format) {
  Outcome with_location = outcome(status, std::move(text), format);
  with_location.has_location = true;
  return with_location;
}

}  // namespace armloom
