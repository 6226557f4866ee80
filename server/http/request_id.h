#pragma once

#include <string>
#include <string_view>

namespace armloom {

inline constexpr std::string_view kRequestIdField = "X-Request-Id";
inline constexpr std::size_t kRequestIdMax = 128;

// Checks a client's request id: 1 to kRequestIdMax characters of [A-Za-z0-9._-].
[[nodiscard]] bool is_request_id(std::string_view text);

// Returns a unique id such as "1f0c93a2-000017"; its first half identifies the process.
// Thread-safe.
[[nodiscard]] std::string fresh_request_id();

}  // namespace armloom
