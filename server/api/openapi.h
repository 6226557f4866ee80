#pragma once

#include <string>
#include <string_view>

#include "server/codec/format.h"

namespace armloom {

// Returns the OpenAPI 3.1 document, made from all routes. test/openapi compares it with a running
// server.
[[nodiscard]] const Schema& openapi_document();
[[nodiscard]] const std::string& openapi_text();

// Pages, compiled in from pages/.
[[nodiscard]] std::string_view docs_html();
[[nodiscard]] std::string_view docs_css();
[[nodiscard]] std::string_view docs_js();
[[nodiscard]] std::string_view login_html();
[[nodiscard]] std::string_view login_js();

}  // namespace armloom
