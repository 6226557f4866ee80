#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "server/http/message.h"

namespace armloom {

// Bytes that many readers get: held once, with their name for caches and, where that is smaller,
// packed by gzip.
struct ServedBytes {
  std::shared_ptr<const std::string> plain;
  std::shared_ptr<const std::string> packed;  // null: not worth it
  std::string tag;                            // of the plain ones, without quotes
};
// `text`: whether packing is tried.
[[nodiscard]] ServedBytes served(std::string bytes, bool text);

// Whether a reader takes gzip (RFC 9110, 12.5.3).
[[nodiscard]] bool accepts_gzip(std::string_view accept_encoding);

// 200 with the bytes as the reader takes them, ETag and Vary.
[[nodiscard]] Response answer_bytes(const Request& request, const ServedBytes& bytes,
                                    std::string content_type);

}  // namespace armloom
