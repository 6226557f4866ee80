#include "server/durable/request_trail.h"

#include <cmath>
#include <cstddef>

namespace armloom {
namespace {

constexpr std::size_t kPathMax = 512;

}  // namespace

Respond RequestTrail::follow(const Request& request, std::string who, Respond respond) const {
  if (keeper_ == nullptr && logged_ == LoggedRequests::none) return respond;
  AuditEntry entry{.who = std::move(who),
                   .peer = request.peer,
                   .method = request.method,
                   .path = request.target.path.substr(0, kPathMax)};
  return [this, entry = std::move(entry), respond = std::move(respond), id = request.id,
          asked = std::chrono::steady_clock::now()](Response response) mutable {
    entry.status = response.status;
    const bool is_refused = entry.status == 401 || entry.status == 403;
    const bool only_looks =
        !is_refused && (entry.method == "GET" || entry.method == "OPTIONS" || response.is_routine);
    tell(entry, id, only_looks, std::chrono::steady_clock::now() - asked);
    if (!only_looks) put_down(std::move(entry));
    respond(std::move(response));
  };
}

void RequestTrail::put_down(AuditEntry entry) const {
  if (keeper_ == nullptr) return;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  entry.at_ms = std::chrono::floor<std::chrono::milliseconds>(now).count();
  keeper_->store().note(std::move(entry));
}

void RequestTrail::tell(const AuditEntry& entry, const std::string& id, bool only_looks,
                        std::chrono::nanoseconds within) const {
  if (logged_ == LoggedRequests::none) return;
  if (logged_ == LoggedRequests::commands && only_looks) return;
  LogLine line{entry.status >= 500 ? LogLine::Level::warning : LogLine::Level::info, "request"};
  line.fields = {
      {"request_id", id},   {"method", entry.method},
      {"path", entry.path}, {"status", std::int64_t{entry.status}},
      {"from", entry.peer}, {"ms", 1e-3 * std::round(1e-3 * static_cast<double>(within.count()))}};
  if (!entry.who.empty()) line.fields.emplace_back("who", entry.who);
  log_(line);
}

}  // namespace armloom
