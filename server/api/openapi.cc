#include "server/api/openapi.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "server/api/route.h"
#include "server/codec/schema_names.h"
#include "server/codec/value_formats.h"
#include "server/messages/events.h"
#include "server/messages/problem.h"

namespace armloom {
namespace {

constexpr const char* kSchemas = "#/components/schemas/";

// What may be refused: by status, the name of the response and what it means.
struct RefusalText {
  const char* name;
  const char* text;
};
const std::map<int, RefusalText>& refusal_texts() {
  static const std::map<int, RefusalText> texts{
      {400, {"BadRequest", "The request, its target or its JSON cannot be read"}},
      {401,
       {"NotAuthenticated",
        "No token was shown, or none of this server's, or one that was revoked"}},
      {403,
       {"ForeignOrigin",
        "A page of another site may not command this server, nor may a Host that is neither an IP "
        "address nor localhost nor given with --allow-host; nor may a token whose role does not "
        "allow it"}},
      {404, {"NotFound", "There is no such thing"}},
      {409, {"Conflict", "It contradicts the present state"}},
      {412, {"PreconditionFailed", "It is not any more as If-Match has it: read it again"}},
      {413, {"TooLarge", "Over a stated bound: 8 MiB, 10,000 waypoints"}},
      {415, {"WrongMediaType", "The body must be application/json"}},
      {417, {"ExpectationFailed", "The only Expect served is 100-continue"}},
      {422,
       {"Unprocessable",
        "It can be read but can never be right: the place and the value found are named"}},
      {426, {"UpgradeRequired", "Not a WebSocket handshake"}},
      {429,
       {"TooMany",
        "More requests or jobs a second, or more connections, than one client may have, or all "
        "together. `Retry-After` says when to come again"}},
      {414, {"TargetTooLong", "A request line of more than 16 KiB"}},
      {431, {"HeaderTooLarge", "A header of more than 16 KiB"}},
      {503,
       {"Unavailable",
        "Right, but not now: the queue is full, the server ends, or too many connections are "
        "open, or what the server keeps cannot be written"}},
      {507, {"StorageFull", "There is no space left to store it: nothing was accepted"}}};
  return texts;
}

Schema header() {
  return {
      {"title", "Armloom"},
      {"version", "1"},
      {"summary", "An execution server for robot cells in which several arms share one workspace."},
      {"description",
       "Clients post joint trajectories; each one starts the moment it is safe beside "
       "everything that is already moving, or waits in the backlog with the reason.\n\nLengths "
       "are in m, angles in rad, times in s (keys end in `_s`, cell time) or RFC 3339 (`_at`, "
       "wall time). Every path also answers HEAD where it answers GET, and 405 with `Allow` "
       "otherwise. Errors are RFC 9457 problem documents that name the place and the value "
       "found."},
      {"license", {{"name", "BSD-3-Clause"}, {"identifier", "BSD-3-Clause"}}}};
}

Schema tags() {
  const std::pair<const char*, const char*> all[] = {
      {"jobs", "Trajectories to be executed"},
      {"arms", "Where they are; stop and resume"},
      {"scene", "Objects that may be in the way"},
      {"events", "Everything that happens, live"},
      {"cell", "What the cell consists of"},
      {"recordings", "What was written down of each run"},
      {"simulation", "Speed and faults of simulated arms"},
      {"service", "The server itself"}};
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
    response["headers"]["Location"] = {{"description", "Where it can be read"},
                                       {"schema", {{"type", "string"}}}};
  }
  if (outcome.has_tag) {
    response["headers"]["ETag"] = {{"description", "For If-Match and If-None-Match"},
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

// Asked for where the server was started with tokens. What a token may is its role's: `x-role` of
// an operation is the least that it takes.
Schema security_schemes() {
  return {{"token",
           {{"type", "http"},
            {"scheme", "bearer"},
            {"description", "Of `armloom token add`; asked for where `serve` has --tokens"}}},
          {"cookie",
           {{"type", "apiKey"},
            {"in", "cookie"},
            {"name", std::string(kTokenCookie)},
            {"description", "The same token, as POST /session sets it for browsers"}}}};
}

// How readers tell messages apart.
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
    whole["components"]["headers"]["RequestId"] = {{"description",
                                                    "Names the request, in the server's log, too: "
                                                    "the request's own X-Request-Id where it sends "
                                                    "one of 1 to 128 characters of [A-Za-z0-9._-]"},
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
