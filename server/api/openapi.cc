#include "server/api/openapi.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "server/api/answer_form.h"
#include "server/api/route.h"
#include "server/codec/schema_names.h"
#include "server/codec/value_formats.h"
#include "server/messages/events.h"
#include "server/messages/problem.h"

namespace armloom {
namespace {

constexpr const char* kSchemas = "#/components/schemas/";

// Describes the responses to refused requests: component name and text, by HTTP status.
struct RefusalText {
  const char* name;
  const char* text;
};
const std::map<int, RefusalText>& refusal_texts() {
  static const std::map<int, RefusalText> texts{
      {400, {"BadRequest", "The request, its target or its JSON is malformed"}},
      {401,
       {"NotAuthenticated", "The request has no token, or its token is unknown or was revoked"}},
      {403,
       {"ForeignOrigin",
        "The request is forbidden: the token's role does not allow it, a page of another site sent "
        "it (see `--allow-origin`), or its Host is neither an IP address nor localhost nor given "
        "with `--allow-host`"}},
      {404, {"NotFound", "Not found"}},
      {409, {"Conflict", "The request conflicts with the present state"}},
      {412,
       {"PreconditionFailed", "The job has changed since the ETag in If-Match; fetch it again"}},
      {413, {"TooLarge", "The body exceeds a limit, for example 8 MiB or 10,000 waypoints"}},
      {415, {"WrongMediaType", "The body must be application/json"}},
      {417, {"ExpectationFailed", "The only supported Expect is 100-continue"}},
      {422,
       {"Unprocessable",
        "The request is well-formed but its content is invalid; the problem names the place and "
        "the value found"}},
      {426, {"UpgradeRequired", "The request is not a WebSocket handshake"}},
      {429,
       {"TooMany",
        "The client, or all clients together, exceed a limit of requests or jobs per second or of "
        "connections. `Retry-After` says when to retry"}},
      {414, {"TargetTooLong", "The request line exceeds 16 KiB"}},
      {431, {"HeaderTooLarge", "The header exceeds 16 KiB"}},
      {503,
       {"Unavailable",
        "The request is valid but cannot be served now: the queue is full, the server is shutting "
        "down, too many connections are open, or the data folder cannot be written"}},
      {507, {"StorageFull", "No disk space is left to store the request"}}};
  return texts;
}

Schema header() {
  return {
      {"title", "Armloom"},
      {"version", "1"},
      {"summary", "An execution server for robot cells in which several arms share one workspace."},
      {"description",
       "Clients post joint trajectories, goals or batches of jobs. Armloom starts each motion as "
       "soon as it is certified collision-free with respect to everything already moving. Jobs "
       "that cannot start yet wait in a backlog, each with the reason why it waits. Armloom runs "
       "simulated arms only and is not a safety system: Stop is an operational stop and does not "
       "replace an emergency stop.\n\nLengths are in m, angles in rad. Times are seconds of cell "
       "time (keys end in `_s`) or RFC 3339 wall time (`_at`). Every path that serves GET also "
       "serves HEAD; other methods are answered 405 with `Allow`. Errors are RFC 9457 problem "
       "documents that name the place and the value found.\n\nAnswers above 1 kB are compressed if "
       "the client accepts gzip. With `?pretty`, JSON is indented. With `Accept: text/plain`, "
       "problems, jobs, arms and the queue are answered as text for people, whose wording is not "
       "part of the contract; other answers remain JSON."},
      {"license", {{"name", "BSD-3-Clause"}, {"identifier", "BSD-3-Clause"}}}};
}

Schema tags() {
  const std::pair<const char*, const char*> all[] = {
      {"jobs", "Submit, check, plan and control jobs"},
      {"arms", "Positions of arms; stop, resume and jog"},
      {"scene", "Objects of the planning scene"},
      {"io", "Inputs and outputs of the cell, such as those of a PLC"},
      {"events", "Live events"},
      {"cell", "The cell, its policy and its meshes"},
      {"recordings", "Recordings of this and earlier sessions"},
      {"simulation", "Speed and faults of simulated arms"},
      {"service", "Health, metrics, alerts, audit log and log-in"}};
  Schema list = Schema::array();
  for (const auto& [name, text] : all) list.push_back({{"name", name}, {"description", text}});
  return list;
}

Schema parameters_of(const Route& route) {
  Schema list = Schema::array();
  std::size_t open = 0;
  while ((open = route.path.find('{', open)) != std::string::npos) {
    const std::size_t close = route.path.find('}', open);
    list.push_back({{"name", route.path.substr(open + 1, close - open - 1)},
                    {"in", "path"},
                    {"required", true},
                    {"schema", {{"type", "string"}}}});
    open = close;
  }
  for (const Parameter& parameter : route.parameters) {
    Schema one{{"name", parameter.name}, {"in", parameter.in}, {"description", parameter.text}};
    if (parameter.required) one["required"] = true;
    one["schema"] = parameter.schema;
    list.push_back(std::move(one));
  }
  if (route.answers_json()) list.push_back({{"$ref", "#/components/parameters/Pretty"}});
  return list;
}

Schema body_of(const Body& body) {
  Schema examples = Schema::object();
  for (const auto& [name, text] : body.examples) examples[name]["value"] = Schema::parse(text);
  return {{"required", true},
          {"content", {{"application/json", {{"schema", body.schema}, {"examples", examples}}}}}};
}

Schema headers_of_all() { return {{"X-Request-Id", {{"$ref", "#/components/headers/RequestId"}}}}; }

Schema outcome_of(const Outcome& outcome) {
  Schema response{{"description", outcome.text}};
  for (const auto& [type, schema] : outcome.content) response["content"][type]["schema"] = schema;
  response["headers"] = headers_of_all();
  if (outcome.has_location) {
    response["headers"]["Location"] = {{"description", "Path of the created resource"},
                                       {"schema", {{"type", "string"}}}};
  }
  if (outcome.has_tag) {
    response["headers"]["ETag"] = {{"description", "Entity tag for If-Match and If-None-Match"},
                                   {"schema", {{"type", "string"}}}};
  }
  return response;
}

Schema responses_of(const Route& route) {
  std::map<int, Schema> by_status;
  for (const Outcome& outcome : route.outcomes) by_status[outcome.status] = outcome_of(outcome);
  std::vector<int> refused = common_refusals(route);
  refused.insert(refused.end(), route.refuses.begin(), route.refuses.end());
  for (const int status : refused) {
    by_status[status] = {
        {"$ref", std::string("#/components/responses/") + refusal_texts().at(status).name}};
  }
  Schema responses = Schema::object();
  for (auto& [status, response] : by_status) {
    responses[std::to_string(status)] = std::move(response);
  }
  return responses;
}

Schema operation_of(const Route& route) {
  Schema operation{{"operationId", route.id}, {"tags", {route.tag}}, {"summary", route.summary}};
  operation["description"] = route.text.empty() ? route.summary : route.text;
  if (Schema parameters = parameters_of(route); !parameters.empty()) {
    operation["parameters"] = std::move(parameters);
  }
  if (route.role) {
    operation["x-role"] = to_string(*route.role);
  } else {
    operation["security"] = Schema::array();
  }
  if (route.reads) operation["requestBody"] = body_of(*route.reads);
  operation["responses"] = responses_of(route);
  return operation;
}

Schema paths() {
  Schema paths = Schema::object();
  for (const Route& route : all_routes()) {
    std::string method = route.method;
    std::ranges::transform(method, method.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    paths[route.path][method] = operation_of(route);
  }
  return paths;
}

Schema refusals() {
  Schema responses = Schema::object();
  for (const auto& [status, refusal] : refusal_texts()) {
    responses[refusal.name] = {
        {"description", refusal.text},
        {"headers", headers_of_all()},
        {"content",
         {{"application/problem+json", {{"schema", problem_format()->schema(Way::out)}}}}}};
  }
  return responses;
}

// Describes how a client authenticates. `x-role` of an operation is the lowest role that may call
// it.
Schema security_schemes() {
  return {
      {"token",
       {{"type", "http"},
        {"scheme", "bearer"},
        {"description",
         "A token printed by `armloom token add`; required if the server runs with `--tokens`"}}},
      {"cookie",
       {{"type", "apiKey"},
        {"in", "cookie"},
        {"name", std::string(kTokenCookie)},
        {"description", "The same token as a cookie, set by POST /session for browsers"}}}};
}

void add_discriminator(Schema& message) {
  Schema mapping = Schema::object();
  for (const auto& [type, name] : message_types()) mapping[type] = kSchemas + name;
  message["discriminator"] = {{"propertyName", "type"}, {"mapping", std::move(mapping)}};
}

}  // namespace

const Schema& openapi_document() {
  static const Schema document = [] {
    Schema schemas = Schema::object();
    Schema whole{{"openapi", "3.1.0"},
                 {"info", header()},
                 {"servers", Schema::array({{{"url", "/"}}})},
                 {"security", Schema::array({{{"token", Schema::array()}},
                                             {{"cookie", Schema::array()}},
                                             Schema::object()})},
                 {"tags", tags()}};
    whole["paths"] = refer_to_names(paths(), kSchemas, schemas);
    const Schema responses = refer_to_names(refusals(), kSchemas, schemas);
    add_discriminator(schemas["Message"]);
    whole["components"] = {{"schemas", std::move(schemas)}, {"responses", responses}};
    whole["components"]["parameters"]["Pretty"] = {
        {"name", kPretty},
        {"in", "query"},
        {"description", "1 or no value: indent the JSON of the answer, for people"},
        {"allowEmptyValue", true},
        {"schema", {{"type", "string"}, {"enum", {"", "0", "1"}}}}};
    whole["components"]["headers"]["RequestId"] = {
        {"description",
         "Id of the request, also in the server's log: the X-Request-Id of the request if it has 1 "
         "to 128 characters of [A-Za-z0-9._-], else a generated id"},
        {"schema", {{"type", "string"}}}};
    whole["components"]["securitySchemes"] = security_schemes();
    return whole;
  }();
  return document;
}

const std::string& openapi_text() {
  static const std::string text = openapi_document().dump(2) + "\n";
  return text;
}

}  // namespace armloom
