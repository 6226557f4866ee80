#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace armloom {

// Headers of every response. Other sites may not frame or embed anything: by clickjacking, their
// pages could stop a cell. Browsers may not guess content types.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSecurityHeaders{{
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Referrer-Policy", "no-referrer"},
}};

// For responses that are not pages.
inline constexpr std::string_view kNoPagePolicy =
    "default-src 'none'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

// For the files of a page: browsers let them load only files of this site.
inline constexpr std::string_view kPagePolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; font-src 'self'; img-src 'self'; "
    "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";

}  // namespace armloom
