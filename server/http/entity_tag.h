#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace armloom {

// Returns an entity tag, without quotes. Equal bytes have equal tags.
[[nodiscard]] std::string tag_of(std::string_view bytes);

// Checks that a field such as If-Match is "*" or a list of entity tags (RFC 9110, 8.8.3).
[[nodiscard]] bool is_tag_list(std::string_view field);

// Returns true if `fits` accepts a tag listed in a field such as If-Match. `fits` gets each tag as
// written, with quotes and "W/", or "*".
[[nodiscard]] bool any_tag(std::string_view field,
                           const std::function<bool(std::string_view)>& fits);

}  // namespace armloom
