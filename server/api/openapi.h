#pragma once

#include <string>
#include <string_view>

#include "server/codec/format.h"

namespace armloom {

// The OpenAPI 3.1 document, made from the routes (api/route.h) and the formats of their messages.
// test/openapi compares it with a running server.
[[nodiscard]] const Schema& openapi_document();
[[nodiscard]] const std::string& openapi_text();

// The page that renders the document, compiled in from the files in pages/.
[[nodiscard]] std::string_view docs_html();
[[nodiscard]] std::string_view docs_css();
[[nodiscard]] std::string_view docs_js();
// The log-in page, compiled in likewise.
[[nodiscard]] std::string_view login_html();
[[nodiscard]] std::string_view login_js();

}  // namespace armloom
