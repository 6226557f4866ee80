#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/codec/format.h"

namespace armloom {

struct AuditRecord {
  std::string at;                  // RFC 3339
  std::optional<std::string> who;  // the token's name
  std::string from;                // an IP address
  std::string method;
  std::string path;
  int status = 0;
};

// Answer to GET /audit-log.
struct AuditPage {
  std::vector<AuditRecord> entries;  // newest first
  std::uint64_t damaged = 0;
  std::optional<std::string> next_cursor;
};
[[nodiscard]] FormatPtr<AuditPage> audit_page_format();

}  // namespace armloom
