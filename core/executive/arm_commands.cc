// Commands to arms: stop, resume, speed override, shutdown.
#include <algorithm>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/executive_impl.h"
#include "core/model/payload.h"

namespace armloom {

void Executive::Impl::stop(const std::vector<ArmId>& arms, const std::string& cause,
                           Alert::Level level, StopCategory category) {
  // Each request stops the arms; only the first one of a cause is published.
  const bool is_news = std::ranges::any_of(arms, [&](ArmId arm) {
    const auto& stop = scheduler_.state().arms.stop_of(arm);
    return !stop || stop->cause != cause;
  });
  if (is_news) {
    publisher_.tell(Alert{level, "stopped: " + names_of(*cell_, arms) + " (" + cause + ")"},
                    clock_.now);
  }
  step(Stop{arms, cause});
  if (category == StopCategory::brake) return;
  for (const ArmId arm : arms) execution_.brake(arm, category);
}

std::vector<ArmId> Executive::Impl::resume(std::vector<ArmId> arms) {
  const auto is_absent = [this](ArmId arm) {
    const ArmLink::State link = execution_.motions().link(arm).state();
    return link == ArmLink::State::connecting || link == ArmLink::State::lost;
  };
  const auto absent =
      std::stable_partition(arms.begin(), arms.end(), [&](ArmId arm) { return !is_absent(arm); });
  const std::vector<ArmId> not_resumed(absent, arms.end());
  arms.erase(absent, arms.end());
  if (!not_resumed.empty()) {
    publisher_.tell(Alert{Alert::Level::warning,
                          "not resumed: " + names_of(*cell_, not_resumed) +
                              " (no link to the controller): resume again when the link is up"},
                    clock_.now);
  }
  if (arms.empty()) return not_resumed;
  publisher_.tell(Alert{Alert::Level::info, "resumed: " + names_of(*cell_, arms)}, clock_.now);
  for (const ArmId arm : arms) watch_.locate(arm);
  for (const ArmId arm : arms) watch_.resumed(arm);
  step(Resume{arms});
  return not_resumed;
}

void Executive::Impl::set_speed(std::optional<ArmId> arm, double share) {
  step(SetSpeed{arm, share});
  pass_on_speed();
}

void Executive::Impl::set_brakes() {
  bool has_changed = false;
  for (const ArmId arm : all_arms(*cell_)) {
    const auto& held = scene_.scene()->attachments();
    const double share = find_overload(*cell_, arm, held) ? 0.0 : kept_brake(*cell_, arm, held);
    if (share == scheduler_.state().speed.brake(arm)) continue;
    has_changed = true;
    step(SetBrake{arm, share});
  }
  if (has_changed) pass_on_speed();
}

void Executive::Impl::pass_on_speed() {
  std::vector<ArmCommand::SetSpeed> speeds;
  const SpeedOverride& speed = scheduler_.state().speed;
  for (ArmId arm : all_arms(*cell_)) {
    const double brake = kept_brake(*cell_, arm, scene_.scene()->attachments());
    speeds.push_back({speed.effective(arm), brake});
  }
  execution_.set_speed(std::move(speeds));
  publisher_.tell_arms(clock_.now);
}

void Executive::Impl::end(const std::string& cause, bool keeps_waiting,
                          std::function<void()> done) {
  clock_.wind_down = {std::move(done), keeps_waiting};
  clients_.intake.close();
  stop(all_arms(*cell_), cause, Alert::Level::info);
}

}  // namespace armloom
