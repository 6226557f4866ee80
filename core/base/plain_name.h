#pragma once

#include <cstddef>
#include <string_view>

namespace armloom {

// A plain name may be part of an API path (robots, arms, objects). It has 1 to kPlainNameMax
// characters of UTF-8, and no slashes, backslashes or control characters. It is not "." or "..",
// because clients resolve these as folders.
inline constexpr std::size_t kPlainNameMax = 128;
inline constexpr const char* kPlainNameRule =
    "a name is 1 to 128 characters without slashes and control characters, and not . or ..";
[[nodiscard]] bool is_plain_name(std::string_view name);

// Counts UTF-8 characters.
[[nodiscard]] std::size_t characters(std::string_view text);

}  // namespace armloom
