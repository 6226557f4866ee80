#pragma once

#include <string>
#include <string_view>

#include "server/codec/format.h"

namespace armloom {

// The description of the whole interface (OpenAPI 3.1): made from the routes (api/route.h) and the
// formats of the messages that they name. test/openapi holds it against a running server.
[[nodiscard]] const Schema& openapi_document();
[[nodiscard]] const std::string& openapi_text();

// The page that renders it, built into the program from the files beside this one.
[[nodiscard]] std::string_view docs_html();
[[nodiscard]] std::string_view docs_css();
[[nodiscard]] std::string_view docs_js();
// Where people log in: likewise.
[[nodiscard]] std::string_view login_html();
[[nodiscard]] std::string_view login_js();

}  // namespace armloom
