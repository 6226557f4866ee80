#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/api/cell_meshes.h"
#include "server/api/parts.h"
#include "server/api/recording_files.h"
#include "server/http/router.h"
#include "server/messages/plain_text.h"

namespace armloom {

// One call of a route. The parts outlive every answer. The request is valid only during the call.
struct Call {
  const ApiParts& parts;
  CellMeshes& meshes;
  const RecordingFiles& recordings;
  const Request& request;
  const Router::Arguments& arguments;  // values of {id} and the like in the path
  Problems faults;                     // only of a stop: other requests are refused before
  Respond respond;
};

struct Parameter {
  std::string name;
  std::string text;
  Schema schema;
  bool required = false;
  const char* in = "query";
};

struct Body {
  Schema schema;
  std::vector<std::pair<std::string, std::string>>
      examples;  // name and JSON; the server accepts each
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

// Describes a route. Its dispatch, the header `Allow` and its entry in /openapi.json are made from
// this.
struct Route {
  std::string method;
  std::string path;  // full path; {id} matches any segment
  std::string id;    // operationId
  std::string tag;
  std::string summary;
  std::string text = "";  // empty if the summary is enough
  std::vector<Parameter> parameters = {};
  std::optional<Body> reads = {};    // nullopt: a command with a body is refused
  std::string instead_of_body = "";  // where the data belongs that a client may send in a body
  std::vector<Outcome> outcomes;
  std::vector<int> refuses = {};  // in addition to common_refusals()
  Who who = Who::reader;
  std::optional<Role> role = Role::viewer;  // nullopt if no token is required
  bool is_stop = false;                     // stops arms; see Rights
  // Returns the answer as text for people; null if it has none. See server/messages/plain_text.h.
  std::string (*as_text)(const Schema& answer, const Present& now) = nullptr;
  void (*run)(Call call);  // not served by the router if null

  [[nodiscard]] bool answers_json() const;
  [[nodiscard]] Rights rights() const { return {who, role, is_stop}; }
};

// The routes of each resource.
[[nodiscard]] std::vector<Route> job_routes();         // /jobs, /queue, /timeline
[[nodiscard]] std::vector<Route> motion_routes();      // /jobs/{id}/trajectory
[[nodiscard]] std::vector<Route> submission_routes();  // POST /jobs, /batches, /check
[[nodiscard]] Route batch_route();
[[nodiscard]] Route amend_route();
[[nodiscard]] std::vector<Route> plan_routes();        // /plan
[[nodiscard]] std::vector<Route> arm_routes();         // /arms, /stop, /resume, /speed
[[nodiscard]] std::vector<Route> control_routes();     // /control, /arms/{name}/jog
[[nodiscard]] std::vector<Route> scene_routes();       // /scene
[[nodiscard]] std::vector<Route> io_routes();          // /io
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

// Returns the HTTP statuses of refusals that a route need not list in `refuses`. Some of them
// depend on the route; for example, 415 only applies to routes that read a body.
[[nodiscard]] std::vector<int> common_refusals(const Route& route);

// Adds the prefix: "/jobs" becomes "/api/v1/jobs".
[[nodiscard]] std::string api_path(const std::string& path);

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
