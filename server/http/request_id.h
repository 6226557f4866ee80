#pragma once

#include <string>
#include <string_view>

namespace armloom {

inline constexpr std::string_view kRequestIdField = "X-Request-Id";
inline constexpr std::size_t kRequestIdMax = 128;

// Whether a client's name for its request may stand in answers and logs: 1 to kRequestIdMax
// characters of [A-Za-z0-9._-].
[[nodiscard]] bool is_request_id(std::string_view text);

// Another one with each call: "1f0c93a2-000017", the first half of this process. Thread-safe.
[[nodiscard]] std::string fresh_request_id();

}  // namespace armloom
