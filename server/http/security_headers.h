#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace armloom {

// What every answer says to a browser: nothing here may be framed or embedded by other sites (a
// click on an invisible frame stopped cells), nothing is what its type does not say.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSecurityHeaders{{
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Referrer-Policy", "no-referrer"},
}};

// Of answers that are no pages; a page has one of its own, which says what it may load.
inline constexpr std::string_view kNoPagePolicy =
    "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

// Of the files of a page: its own files, and nothing else.
inline constexpr std::string_view kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; font-src 'self'; img-src 'self'; "
    "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

}  // namespace armloom
