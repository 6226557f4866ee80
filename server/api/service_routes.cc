#include <utility>

#include "server/api/openapi.h"
#include "server/api/route.h"
#include "server/codec/cell_schema.h"
#include "server/http/security_headers.h"
#include "server/http/served_bytes.h"
#include "server/messages/arm.h"

namespace armloom {
namespace {

Response fresh(const Request& request, const char* content_type, const ServedBytes& bytes) {
  Response response = answer_bytes(request, bytes, content_type);
  response.headers.emplace_back("Cache-Control", "no-cache");
  return response;
}
ServedBytes served_text(std::string_view text) { return served(std::string(text), true); }

void get_health(Call call) { call.respond(answer(200, health_format(), Health{})); }

// Returns why the server is not ready, or nullopt.
std::optional<Refusal> why_not_ready(const ApiParts& parts) {
  if (auto refusal = refusal_of_store(parts)) {
    refusal->status = 503;
    return refusal;
  }
  if (parts.guard.fault()) {  // no details: this route needs no token
    return Refusal{503, "tokens-unreadable", "token file missing or invalid; see the log",
                   "--tokens"};
  }
  const auto lost = parts.recording != nullptr ? parts.recording->fault() : std::nullopt;
  if (!lost) return std::nullopt;
  return Refusal{503, "recording-lost", said_of_lost_recording(*lost), "--data", *lost};
}

void get_ready(Call call) {
  if (const auto why = why_not_ready(call.parts)) return call.respond(refusal_response(*why));
  ask(
      call.parts, [](Executive& executive) { return Ready{executive.now()}; },
      [respond = std::move(call.respond)](const Ready& ready) {
        respond(answer(200, ready_format(), ready));
      });
}

void get_metrics(Call call) {
  const ApiParts& parts = call.parts;
  const Metrics::Readings readings{
      .readers = parts.hub.readers(),
      .frames_dropped = parts.hub.frames_dropped(),
      .subscribers_disconnected = parts.hub.subscribers_disconnected(),
      .recording_lost = parts.recording != nullptr && parts.recording->fault(),
      .storage_failed = refusal_of_store(parts).has_value()};
  call.respond(Response{200,
                        "text/plain; version=0.0.4; charset=utf-8",
                        parts.metrics.text(readings),
                        {{"Cache-Control", "no-store"}}});
}

void get_openapi(Call call) {
  static const ServedBytes bytes = served_text(openapi_text());
  call.respond(fresh(call.request, "application/json", bytes));
}

void get_cell_schema(Call call) {
  static const ServedBytes bytes = served_text(cell_schema_text());
  call.respond(fresh(call.request, "application/schema+json", bytes));
}

void get_docs(Call call) {
  static const ServedBytes bytes = served_text(docs_html());
  Response response = fresh(call.request, "text/html; charset=utf-8", bytes);
  response.headers.emplace_back("Content-Security-Policy", std::string(kPagePolicy));
  call.respond(std::move(response));
}

void get_docs_style(Call call) {
  static const ServedBytes bytes = served_text(docs_css());
  call.respond(fresh(call.request, "text/css; charset=utf-8", bytes));
}

void get_docs_script(Call call) {
  static const ServedBytes bytes = served_text(docs_js());
  call.respond(fresh(call.request, "text/javascript; charset=utf-8", bytes));
}

Route of_server(const char* path, const char* id, const char* summary, Outcome outcome,
                void (*run)(Call)) {
  return {.method = "GET",
          .path = path,
          .id = id,
          .tag = "service",
          .summary = summary,
          .outcomes = {std::move(outcome)},
          .run = run};
}

}  // namespace

std::vector<Route> service_routes() {
  const Schema object{{"type", "object"}};
  const Content html{"text/html", {{"type", "string"}}};
  const Content style{"text/css", {{"type", "string"}}};
  const Content script{"text/javascript", {{"type", "string"}}};
  Route dashboard =
      of_server("/", "dashboard", "The dashboard", {200, "The page", {html}}, nullptr);
  dashboard.outcomes.push_back({303, "Redirect to /login: a token is required"});
  dashboard.refuses = {404};
  Route health = of_server("/healthz", "health", "Check that the process is running",
                           outcome(200, "The process is running", health_format()), get_health);
  Route ready =
      of_server("/readyz", "ready",
                "Check that the executive responds and storage, tokens and recording work",
                outcome(200, "The server is ready", ready_format()), get_ready);
  health.who = ready.who = Who::anyone;  // probes may use any Host
  std::vector<Route> routes{
      health,
      ready,
      of_server("/metrics", "metrics", "Get metrics for Prometheus",
                {200, "Prometheus text format 0.0.4", {{"text/plain", {{"type", "string"}}}}},
                get_metrics),
      of_server("/openapi.json", "openapi", "Get this document",
                {200, "OpenAPI 3.1", {{"application/json", object}}}, get_openapi),
      of_server("/cell.schema.json", "cellSchema", "Get the JSON schema of cell files, for editors",
                {200, "JSON Schema, draft 2020-12", {{"application/schema+json", object}}},
                get_cell_schema),
      of_server("/docs", "docs", "Read this document as a page", {200, "A page", {html}}, get_docs),
      of_server("/docs.css", "docsStyle", "Get the style sheet of /docs",
                {200, "A style sheet", {style}}, get_docs_style),
      of_server("/docs.js", "docsScript", "Get the script of /docs", {200, "A script", {script}},
                get_docs_script),
      dashboard,
  };
  for (Route& route : routes) {  // only the metrics reveal what the cell does
    if (route.path != "/metrics") route.role = std::nullopt;
  }
  return routes;
}

}  // namespace armloom
