#include "server/api/audit_query.h"

#include <optional>
#include <string>
#include <utility>

#include "server/codec/rfc3339.h"

namespace armloom {
namespace {

QueryPart<AuditQuery> time(std::string name, std::optional<std::int64_t> AuditFilter::*where,
                           std::string told) {
  const std::string rule = name + " is a time of RFC 3339, as 2026-11-21T09:33:00Z";
  return {{std::move(name), std::move(told), {{"type", "string"}}},
          [where, rule](const std::string& value, AuditQuery& out) {
            out.*where = read_rfc3339(value);
            return out.*where ? std::nullopt : std::optional(rule);
          }};
}

}  // namespace

const QueryFormat<AuditQuery>& audit_query() {
  using Query = AuditQuery;
  static const QueryFormat<Query> format(
      {
          query::text<Query>("who", &Query::who, "The token's name; empty: where none was shown"),
          query::text<Query>("from", &Query::from, "The address that it came from"),
          query::text<Query>("method", &Query::method, "POST, DELETE, ..."),
          query::text<Query>("path", &Query::path, "What the path begins with"),
          query::whole_number<Query>("status", &Query::status, 100, 599, "Of the answer"),
          time("since", &Query::since_ms, "Answered then or later: RFC 3339"),
          time("before", &Query::before_ms, "Answered earlier: RFC 3339"),
          query::limit<Query>(&Query::limit),
          query::cursor<Query>(&Query::below),
      },
      ProblemKind::invalid);
  return format;
}

}  // namespace armloom
