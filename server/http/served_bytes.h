#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "server/http/message.h"

namespace armloom {

// Bytes for many clients, stored once with their entity tag. Also stored compressed by gzip if that
// is smaller.
struct ServedBytes {
  std::shared_ptr<const std::string> plain;
  std::shared_ptr<const std::string> packed;  // null if not smaller
  std::string tag;                            // of `plain`, without quotes
};
// Compresses the bytes if `text` is true and they become smaller.
[[nodiscard]] ServedBytes served(std::string bytes, bool text);

// Smaller bytes fit one packet anyway and are not compressed.
inline constexpr std::size_t kPackFrom = 1024;

// `level`: from 1, fast, to 9, small.
[[nodiscard]] std::string gzipped(const std::string& bytes, int level);

// Returns true if the client accepts gzip (RFC 9110, 12.5.3).
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

// Returns 200 with the bytes in an encoding that the client accepts, ETag and Vary.
[[nodiscard]] Response answer_bytes(const Request& request, const ServedBytes& bytes,
                                    std::string content_type);

}  // namespace armloom
