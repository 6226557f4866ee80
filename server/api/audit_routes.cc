#include <utility>

#include "server/api/audit_query.h"
#include "server/api/route.h"
#include "server/codec/rfc3339.h"
#include "server/messages/audit.h"

namespace armloom {
namespace {

AuditRecord record_of(const AuditEntry& entry) {
  const auto who = entry.who.empty() ? std::nullopt : std::optional(entry.who);
  return {rfc3339(entry.at_ms), who, entry.peer, entry.method, entry.path, entry.status};
}

AuditPage page_of(const AuditEntries& found, std::size_t limit) {
  AuditPage page{.entries = {}, .damaged = found.damaged, .next_cursor = {}};
  for (const AuditEntry& entry : found.entries) {
    if (page.entries.size() == limit) {  // there is a next page
      page.next_cursor = std::to_string(entry.number + 1);
      break;
    }
    page.entries.push_back(record_of(entry));
  }
  return page;
}

void get_audit(Call call) {
  const ApiParts& parts = call.parts;
  const auto query = audit_query().read(call.request.target);
  if (!query) return call.respond(problem_response(query.error()));
  if (parts.keeper == nullptr) {
    return call.respond(refusal_response(
        {404, "not-kept", "the audit log is kept only by a server started with --data", "--data"}));
  }
  parts.aside([&parts, query = *query, respond = std::move(call.respond)] {
    auto entries =
        std::make_shared<Result<AuditEntries>>(parts.keeper->lists().audit(query, query.limit + 1));
    parts.post([entries, respond, limit = query.limit] {
      respond(*entries ? answer(200, audit_page_format(), page_of(**entries, limit))
                       : problem_response(entries->error()));
    });
  });
}

}  // namespace

std::vector<Route> audit_routes() {
  return {{.method = "GET",
           .path = api_path("/audit-log"),
           .id = "listAuditLog",
           .tag = "service",
           .summary = "List the audit log, newest first",
           .text =
               "Records who sent each request that changes something, and each request that was "
               "refused for a missing token or role, with time, address and status. Kept only with "
               "`--data`: the last 100,000 successful entries and, separately, the last 100,000 "
               "refused ones (4xx), so that refused requests cannot displace successful ones.",
           .parameters = audit_query().parameters(),
           .outcomes = {outcome(200, "A page of the audit log", audit_page_format())},
           .refuses = {404, 422},
           .role = Role::admin,
           .run = get_audit}};
}

}  // namespace armloom
