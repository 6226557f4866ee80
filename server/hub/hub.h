#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/http/message.h"

namespace armloom {

// Distributes events to many subscribers. Keeps the latest events, limited in number and bytes;
// each subscriber reads them at its own pace and can resume. A subscriber whose next event is no
// longer kept is disconnected with the reason: no event is skipped silently. Pose frames are not
// kept: a subscriber that has read all events gets the newest frame. Use on the server's thread.
class Hub {
 public:
  using Text = std::shared_ptr<const std::string>;
  inline static constexpr std::size_t kRing = 16'384;                   // events
  inline static constexpr std::size_t kBytes = std::size_t{32} << 20U;  // of all events

  explicit Hub(std::size_t ring = kRing, std::size_t bytes = kBytes)
      : capacity_(ring), bytes_max_(bytes) {}

  // Precondition: `seq` is the previous number plus one (throws std::logic_error).
  void publish(std::uint64_t seq, Text event);
  void publish_frame(Text frame);

  // Returns a subscriber that gets `first`, then every event after `since`. Returns null if these
  // events are not all kept, or `since` has not happened yet.
  [[nodiscard]] SubscriptionPtr resume(std::uint64_t since, Text first = nullptr);

  // Disconnects present and future subscribers, each after it has got all events.
  void end();

  [[nodiscard]] std::size_t readers();
  [[nodiscard]] std::uint64_t frames_dropped() const { return frames_dropped_; }
  [[nodiscard]] std::uint64_t subscribers_disconnected() const { return subscribers_disconnected_; }

 private:
  class Reader;
  void tell_readers();

  std::size_t capacity_;
  std::size_t bytes_max_;
  std::size_t bytes_ = 0;  // kept
  std::deque<Text> ring_;  // ends with the event last_seq_
  std::uint64_t last_seq_ = 0;
  bool ended_ = false;
  std::uint64_t frames_dropped_ = 0;
  std::uint64_t subscribers_disconnected_ = 0;
  std::vector<std::weak_ptr<Reader>> readers_;
};

}  // namespace armloom
