#pragma once

#include <string_view>

#include "server/http/router.h"

namespace armloom {

// The description of the whole interface (OpenAPI 3.1) and a page that renders it, both built into
// the program from the files beside this one. test/openapi holds the description against a running
// server: every route, every answer, every message.
[[nodiscard]] std::string_view openapi_json();
[[nodiscard]] std::string_view docs_html();

// GET /openapi.json, GET /cell.schema.json, GET /docs
void add_openapi_routes(Router& router);

}  // namespace armloom
