#include "server/api/audit_query.h"

#include <optional>
#include <string>
#include <utility>

#include "server/codec/rfc3339.h"

namespace armloom {
namespace {

QueryPart<AuditQuery> time(std::string name, std::optional<std::int64_t> AuditFilter::*where,
                           std::string description) {
  const std::string rule = name + " must be an RFC 3339 time, for example 2026-11-21T09:33:00Z";
  return {{std::move(name), std::move(description), {{"type", "string"}}},
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
          query::text<Query>(
              "who", &Query::who,
              "Only requests of this token (its name); empty: only requests without a token"),
          query::text<Query>("from", &Query::from, "Only requests from this IP address"),
          query::text<Query>("method", &Query::method,
                             "Only this HTTP method, for example POST or DELETE"),
          query::text<Query>("path", &Query::path, "Only paths that begin with this text"),
          query::whole_number<Query>("status", &Query::status, 100, 599,
                                     "Only answers with this HTTP status"),
          time("since", &Query::since_ms,
               "Only requests answered at this time or later (RFC 3339)"),
          time("before", &Query::before_ms, "Only requests answered before this time (RFC 3339)"),
          query::limit<Query>(&Query::limit),
          query::cursor<Query>(&Query::below),
      },
      ProblemKind::invalid);
  return format;
}

}  // namespace armloom
