// Who did what, from where.
#include <charconv>
#include <chrono>
#include <utility>

#include "server/api/route.h"
#include "server/codec/value_formats.h"
#include "server/messages/audit.h"

namespace armloom {
namespace {

constexpr std::size_t kPage = 100;
constexpr std::size_t kPageMax = 1000;

struct AuditQuery {
  std::size_t limit = kPage;
  std::optional<std::uint64_t> before = {};
};

template <class Number>
bool read_whole(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, ec] = std::from_chars(text.data(), end, number);
  return ec == std::errc{} && stop == end;
}

Result<AuditQuery> read_query(const Target& target) {
  AuditQuery query;
  if (const auto limit = target.parameter("limit")) {
    if (!read_whole(*limit, query.limit) || query.limit < 1 || query.limit > kPageMax) {
      return failure(Problem{ProblemKind::invalid, "bad-parameter", "?limit",
                             "limit is an integer within 1..1000", *limit});
    }
  }
  if (const auto cursor = target.parameter("cursor")) {
    if (!read_whole(*cursor, query.before.emplace())) {
      return failure(Problem{ProblemKind::invalid, "bad-parameter", "?cursor",
                             "this is no cursor that the server gave", *cursor});
    }
  }
  return query;
}

AuditRecord record_of(const AuditEntry& entry) {
  const WallClock::Wall wall{std::chrono::milliseconds(entry.at_ms)};
  const auto who = entry.who.empty() ? std::nullopt : std::optional(entry.who);
  return {WallClock(wall, 1.0).at(TimePoint{}),
          who,
          entry.peer,
          entry.method,
          entry.path,
          entry.status};
}

AuditPage page_of(const std::vector<AuditEntry>& entries, std::size_t limit) {
  AuditPage page;
  for (const AuditEntry& entry : entries) {  // one more than a page holds, where there is more
    if (page.entries.size() == limit) {
      page.next_cursor = std::to_string(entry.number + 1);
      break;
    }
    page.entries.push_back(record_of(entry));
  }
  return page;
}

void get_audit(Call call) {
  const ApiParts& parts = call.parts;
  const auto query = read_query(call.request.target);
  if (!query) return call.respond(problem_response(query.error()));
  if (parts.keeper == nullptr) {
    return call.respond(
        refusal_response({404, "not-kept", "who did what is kept with --data alone", "--data"}));
  }
  parts.aside([&parts, query = *query, respond = std::move(call.respond)] {
    auto entries = std::make_shared<Result<std::vector<AuditEntry>>>(
        parts.keeper->lists().audit(query.before, query.limit + 1));
    parts.post([entries, respond, limit = query.limit] {
      respond(*entries ? answer(200, audit_page_format(), page_of(**entries, limit))
                       : problem_response(entries->error()));
    });
  });
}

}  // namespace

std::vector<Route> audit_routes() {
  const Schema text{{"type", "string"}};
  return {
      {.method = "GET",
       .path = api_path("/audit"),
       .id = "listAudit",
       .tag = "service",
       .summary = "Who did what, when, from where; newest first",
       .text =
           "Everything but what only looks, and everything that was refused for want of a "
           "token or a role. Kept with `--data`: the last 100,000 that did something, and the last "
           "100,000 that were refused (4xx), which displace nothing of the former.",
       .parameters = {{"limit", "At most so many, 100 unless given",
                       formats::integer(1, kPageMax)->schema(Way::in)},
                      {"cursor", "next_cursor of the page before", text}},
       .outcomes = {outcome(200, "A page", audit_page_format())},
       .refuses = {404, 422},
       .role = Role::admin,
       .run = get_audit}};
}

}  // namespace armloom
