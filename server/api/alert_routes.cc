#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>

#include "server/api/route.h"
#include "server/messages/alert.h"

namespace armloom {
namespace {

void get_alerts(Call call) {
  // Runs after all tasks that are already posted. A stop is answered ahead of them, so its alert
  // may still be among them.
  call.parts.post([&parts = call.parts, respond = call.respond] {
    const auto& alerts = parts.alerts.alerts();
    AlertList list;
    list.alerts.assign(alerts.rbegin(), alerts.rend());
    respond(answer(200, alert_list_format(), list));
  });
}

// Returns the token's name if tokens are required, because it is proven. Otherwise returns the name
// that the client sent, or the client's address.
std::string who_of(const Guard& guard, const std::optional<Caller>& caller, const AlertsSeen& seen,
                   const std::string& peer) {
  if (guard.asks() && caller) return caller->name;
  return seen.who && !seen.who->empty() ? *seen.who : peer;
}

std::optional<Refusal> unknown_of(const AlertBook& book, const AlertsSeen& seen) {
  for (std::size_t i = 0; i < seen.ids.size(); ++i) {
    if (book.find(seen.ids[i]) != nullptr) continue;
    return Refusal{404, "not-found",
                   "no alert \"" + seen.ids[i] + "\": it never existed or is no longer kept",
                   "/ids/" + std::to_string(i), seen.ids[i]};
  }
  return std::nullopt;
}

std::vector<std::string> unseen_of(const AlertBook& book, const AlertsSeen& seen) {
  std::vector<std::string> unseen;
  std::ranges::copy_if(seen.ids, std::back_inserter(unseen),
                       [&](const std::string& id) { return !book.find(id)->acknowledged; });
  return unseen;
}

void tell_others(const ApiParts& parts, const std::string& who,
                 const std::vector<std::string>& ids) {
  const std::size_t count = ids.size();
  const std::string what =
      count == 1 ? parts.alerts.find(ids.front())->text : std::to_string(count) + " alerts";
  parts.loop.post([text = who + " acknowledged: " + what](Executive& executive) {
    executive.alert({Alert::Level::info, text});
  });
}

void acknowledge(Call call) {
  const ApiParts& parts = call.parts;
  const Respond respond = std::move(call.respond);
  const auto go_on = [&parts, caller = parts.guard.caller(call.request.token),
                      peer = call.request.peer, respond](const AlertsSeen& seen) {
    if (const auto refusal = unknown_of(parts.alerts, seen)) {
      return respond(refusal_response(*refusal));
    }
    const std::string who = who_of(parts.guard, caller, seen, peer);
    if (const auto news = unseen_of(parts.alerts, seen); !news.empty()) {
      tell_others(parts, who, news);
    }
    parts.alerts.acknowledge(
        seen.ids, who, [&parts, ids = seen.ids, respond](const std::optional<Refusal>& refusal) {
          if (refusal) return respond(done_but_not_stored(*refusal));
          AlertList list;
          for (const std::string& id : ids) {
            if (const auto* alert = parts.alerts.find(id)) list.alerts.push_back(*alert);
          }
          respond(answer(200, alert_list_format(), list));
        });
  };
  read_body(parts, call.request, respond, read_alerts_seen, go_on);
}

}  // namespace

std::vector<Route> alert_routes() {
  Route get{.method = "GET",
            .path = api_path("/alerts"),
            .id = "listAlerts",
            .tag = "service",
            .summary = "List warnings and errors with their acknowledgements, newest first",
            .text =
                "Keeps at most 1,000 alerts. Beyond that, acknowledged alerts are dropped first "
                "and errors last. With `--data`, alerts of earlier sessions are included."};
  get.outcomes = {outcome(200, "The alerts", alert_list_format())};
  get.run = get_alerts;
  Route seen{.method = "POST",
             .path = api_path("/alerts/acknowledge"),
             .id = "acknowledgeAlerts",
             .tag = "service",
             .summary = "Acknowledge alerts",
             .text =
                 "Acknowledges all listed alerts, or none if one of them is unknown. If an alert "
                 "was already acknowledged, its first acknowledgement is kept. With `--data`, the "
                 "acknowledgement is on disk before the answer. Event subscribers are informed."};
  seen.reads = body(alerts_seen_format(), {{"none", R"({"ids": [], "who": "Ada"})"}});
  seen.outcomes = {outcome(200, "The acknowledged alerts", alert_list_format())};
  seen.refuses = {404, 422, 507};
  seen.who = Who::commander;
  seen.role = Role::operate;
  seen.run = acknowledge;
  return {get, seen};
}

}  // namespace armloom
