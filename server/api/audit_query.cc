#include "server/api/audit_query.h"

#include <optional>
#include <string>
#include <utility>

#include "server/api/query_number.h"
#include "server/codec/rfc3339.h"

namespace armloom {

Result<AuditQuery> read_audit_query(const Target& target) {
  AuditQuery query;
  AuditFilter& filter = query.filter;
  Problems problems;
  const auto refuse = [&](const std::string& name, const std::string& value, std::string detail) {
    problems.push_back(
        Problem{ProblemKind::invalid, "bad-parameter", "?" + name, std::move(detail), value});
  };
  const auto time = [&](const std::string& name, const std::string& value) {
    const auto read = read_rfc3339(value);
    if (!read) refuse(name, value, name + " is a time of RFC 3339, as 2026-11-21T09:33:00Z");
    return read;
  };
  for (const auto& [name, value] : target.query) {
    if (name == "who") filter.who = value;
    if (name == "from") filter.from = value;
    if (name == "method") filter.method = value;
    if (name == "path") filter.path = value;
    if (name == "since") filter.since_ms = time(name, value);
    if (name == "before") filter.before_ms = time(name, value);
    if (name == "status" && !read_between(value, 100, 599, filter.status.emplace())) {
      refuse(name, value, "status is an integer within 100..599");
    }
    if (name == "limit" &&
        !read_between<std::size_t>(value, 1, AuditQuery::kLimitMax, query.limit)) {
      refuse(name, value, "limit is an integer within 1..1000");
    }
    if (name == "cursor" &&
        !read_between<std::uint64_t>(value, 0, ~std::uint64_t{0}, filter.below.emplace())) {
      refuse(name, value, "this is no cursor that the server gave");
    }
  }
  if (!problems.empty()) return failure(std::move(problems));
  return query;
}

}  // namespace armloom
