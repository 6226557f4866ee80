#include "server/hub/broadcast.h"

#include <algorithm>
#include <utility>

#include "server/messages/events.h"

namespace armloom {

namespace {

// Returns the line of an alert or of a finding of the monitor that stops an arm, else nullopt:
// noise could cause many other findings each second.
std::optional<LogLine> line_of(const Event& event) {
  const auto alert = alert_of(event);
  if (!alert) return std::nullopt;
  const auto level = alert->level == Alert::Level::error     ? LogLine::Level::error
                     : alert->level == Alert::Level::warning ? LogLine::Level::warning
                                                             : LogLine::Level::info;
  LogLine line{level,
               alert->text,
               {{"seq", static_cast<std::int64_t>(event.seq)},
                {"t_s", to_seconds(event.time.time_since_epoch())}}};
  const auto* found = std::get_if<MonitorEvent>(&event.body);
  if (found == nullptr) return line;
  if (found->stopped.empty()) return std::nullopt;
  std::string stopped;
  for (const std::string& arm : found->stopped) stopped += (stopped.empty() ? "" : ",") + arm;
  line.fields.emplace_back("stopped", std::move(stopped));
  return line;
}

}  // namespace

void Broadcast::on_event(const Event& event) {
  parts_.post([this, event = std::make_shared<const Event>(event)] {
    const auto text =
        std::make_shared<const std::string>(event_json(*event, parts_.stream, &parts_.clock));
    if (parts_.recording != nullptr) parts_.recording->event(*text);
    const auto* job = std::get_if<JobView>(&event->body);
    if (job != nullptr && parts_.keeper != nullptr) parts_.keeper->see(*job);
    const auto* scene = std::get_if<SceneView>(&event->body);
    if (scene != nullptr && parts_.keeper != nullptr) parts_.keeper->forget(scene->expired);
    parts_.alerts.happened(*event);
    if (const auto line = line_of(*event)) parts_.log(*line);
    parts_.hub.publish(event->seq, text);
    parts_.metrics.happened(*event);
  });
}

void Broadcast::watch_recording() {
  if (said_lost_ || parts_.recording == nullptr) return;
  const auto fault = parts_.recording->fault();
  if (!fault) return;
  said_lost_ = true;
  parts_.tell({Alert::Level::error, said_of_lost_recording(*fault)});
}

void Broadcast::on_tick(TimePoint now, const Configuration& measured) {
  parts_.metrics.ticked();
  if (parts_.recording != nullptr) parts_.recording->state(now, measured);
}

void Broadcast::on_rest(bool at_rest) {
  if (parts_.recording != nullptr) parts_.recording->at_rest(at_rest);
}

void Broadcast::on_stops(const std::vector<ArmId>& stopped) {
  if (parts_.keeper == nullptr) return;
  std::vector<std::string> names;
  for (ArmId arm : stopped) names.push_back(parts_.cell->arm(arm).name);
  // The reply to the stop request goes through the same urgent queue, so the stop is recorded
  // before the reply.
  parts_.post_urgent([this, names = std::move(names)] { parts_.keeper->stopped(names); });
}

void Broadcast::on_state(const StateFrame& frame) {
  parts_.metrics.watched(frame);
  const auto now = std::chrono::steady_clock::now();
  if (now < next_frame_) return;
  const std::chrono::milliseconds shared(1000 * readers_.load() / kFramesPerSecond);
  next_frame_ = std::max(next_frame_ + std::max(kFramePeriod, shared), now);
  const auto wall = std::chrono::system_clock::now();
  parts_.post([this, wall, now, frame = std::make_shared<const StateFrame>(frame)] {
    parts_.clock.observe(frame->time, wall);
    parts_.states.take(frame->time, frame->q, now);
    watch_recording();
    readers_ = parts_.hub.readers();
    if (readers_ == 0) return;
    parts_.hub.publish_frame(std::make_shared<const std::string>(
        state_json(*frame, *parts_.cell, parts_.clock.speed())));
  });
}

}  // namespace armloom
