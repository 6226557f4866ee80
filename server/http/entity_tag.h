#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace armloom {

// The same for the same bytes; what may stand in an ETag, without its quotes.
[[nodiscard]] std::string tag_of(std::string_view bytes);

// Whether a field such as If-Match is "*" or a list of entity tags (RFC 9110, 8.8.3).
[[nodiscard]] bool is_tag_list(std::string_view field);

// Whether one of the tags that a field such as If-Match lists fits: each is given as it stands
// there, with its quotes and "W/", or "*" alone.
[[nodiscard]] bool any_tag(std::string_view field,
                           const std::function<bool(std::string_view)>& fits);

}  // namespace armloom
