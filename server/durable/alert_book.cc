#include "server/durable/alert_book.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

namespace armloom {

std::optional<Alert> alert_of(const Event& event) {
  if (const auto* alert = std::get_if<Alert>(&event.body)) return *alert;
  const auto* found = std::get_if<MonitorEvent>(&event.body);
  if (found == nullptr) return std::nullopt;
  return Alert{found->stopped.empty() ? Alert::Level::warning : Alert::Level::error,
               "monitor: " + found->text};
}

AlertBook::AlertBook(std::string stream, const WallClock& clock, JobKeeper* keeper)
    : stream_(std::move(stream)), clock_(clock), keeper_(keeper) {
  if (keeper_ == nullptr) return;
  const auto& left = keeper_->store().leftover().alerts;
  alerts_.assign(left.begin(), left.end());
}

void AlertBook::happened(const Event& event) {
  const auto told = alert_of(event);
  if (!told || told->level == Alert::Level::info) return;
  StoredAlert alert{.id = stream_ + ":" + std::to_string(event.seq),
                    .at_ms = since_1970_ms(clock_.wall_at(event.time)),
                    .level = to_string(told->level),
                    .text = told->text};
  alerts_.push_back(alert);
  if (alerts_.size() > kAlertsKept) alerts_.erase(least_needed());
  if (keeper_ != nullptr) keeper_->store().keep(std::move(alert));
}

// Returns the oldest acknowledged alert, else the oldest warning, else the oldest error.
std::deque<StoredAlert>::const_iterator AlertBook::least_needed() const {
  const auto oldest = [&](auto goes) { return std::ranges::find_if(alerts_, goes); };
  const auto seen = oldest([](const StoredAlert& one) { return one.acknowledged.has_value(); });
  if (seen != alerts_.end()) return seen;
  const auto warning = oldest([](const StoredAlert& one) { return one.level != "error"; });
  return warning != alerts_.end() ? warning : alerts_.begin();
}

const StoredAlert* AlertBook::find(const std::string& id) const {
  const auto found = std::ranges::find(alerts_, id, &StoredAlert::id);
  return found == alerts_.end() ? nullptr : &*found;
}

void AlertBook::acknowledge(const std::vector<std::string>& ids, const std::string& who,
                            std::function<void(std::optional<Refusal>)> then) {
  const StoredAlert::Acknowledgement now{who, since_1970_ms(std::chrono::system_clock::now())};
  for (const std::string& id : ids) {
    StoredAlert& alert = *std::ranges::find(alerts_, id, &StoredAlert::id);
    if (alert.acknowledged) continue;
    alert.acknowledged = now;
    if (keeper_ != nullptr) keeper_->store().keep(alert);
  }
  if (keeper_ == nullptr) return then(std::nullopt);
  keeper_->when_written(std::move(then));
}

}  // namespace armloom
