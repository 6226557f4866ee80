#include "server/openapi/openapi.h"

#include <string>
#include <utility>

#include "server/codec/cell_schema.h"

namespace armloom {
namespace {

Response page(const char* content_type, std::string_view text) {
  return Response{200, content_type, std::string(text), {{"Cache-Control", "no-cache"}}};
}

}  // namespace

void add_openapi_routes(Router& router) {
  router.add("GET", "/openapi.json", [](const Request&, const Router::Arguments&, Respond respond) {
    respond(page("application/json", openapi_json()));
  });
  router.add("GET", "/cell.schema.json",
             [](const Request&, const Router::Arguments&, Respond respond) {
               respond(page("application/schema+json", cell_schema_text()));
             });
  router.add("GET", "/docs", [](const Request&, const Router::Arguments&, Respond respond) {
    Response response = page("text/html; charset=utf-8", docs_html());
    response.headers.emplace_back(
        "Content-Security-Policy",
        "default-src 'none'; connect-src 'self'; script-src 'unsafe-inline'; "
        "style-src 'unsafe-inline'; img-src data:");
    respond(std::move(response));
  });
}

}  // namespace armloom
