// Who did what, from where.
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
    if (page.entries.size() == limit) {  // one more than a page holds: there is more
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
    return call.respond(
        refusal_response({404, "not-kept", "who did what is kept with --data alone", "--data"}));
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
  return {
      {.method = "GET",
       .path = api_path("/audit-log"),
       .id = "listAuditLog",
       .tag = "service",
       .summary = "Who did what, when, from where; newest first",
       .text =
           "Everything but what only looks, and everything that was refused for want of a "
           "token or a role. Kept with `--data`: the last 100,000 that did something, and the last "
           "100,000 that were refused (4xx), which displace nothing of the former.",
       .parameters = audit_query().parameters(),
       .outcomes = {outcome(200, "A page", audit_page_format())},
       .refuses = {404, 422},
       .role = Role::admin,
       .run = get_audit}};
}

}  // namespace armloom
