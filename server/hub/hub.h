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

// Where events become messages for many readers. Holds the latest events in a ring, bounded in
// events and in bytes, from which every reader is served at its own pace and can resume; a reader
// that falls farther behind than the ring is sent away and told so: events are never skipped in
// silence. Pose frames are not kept: a reader gets the newest one when it has no event left to
// read. Not thread-safe: everything on the server's thread.
class Hub {
 public:
  using Text = std::shared_ptr<const std::string>;
  inline static constexpr std::size_t kRing = 16'384;                   // events
  inline static constexpr std::size_t kBytes = std::size_t{32} << 20U;  // of all of them

  explicit Hub(std::size_t ring = kRing, std::size_t bytes = kBytes)
      : capacity_(ring), bytes_max_(bytes) {}

  // Precondition: seq follows the one before by one (throws std::logic_error): the log has no
  // holes.
  void publish(std::uint64_t seq, Text event);
  void publish_frame(Text frame);

  // A reader that gets `first` and then every event after `since`.
  // Null: the events after `since` are not all in the ring, or `since` is still to come.
  [[nodiscard]] SubscriptionPtr resume(std::uint64_t since, Text first = nullptr);

  // Sends every reader away, those to come as well, each when it has read what there is.
  void end();

  [[nodiscard]] std::size_t readers();
  [[nodiscard]] std::uint64_t frames_dropped() const { return frames_dropped_; }
  [[nodiscard]] std::uint64_t readers_sent_away() const { return readers_sent_away_; }

 private:
  class Reader;
  void tell_readers();

  std::size_t capacity_;
  std::size_t bytes_max_;
  std::size_t bytes_ = 0;  // in the ring
  std::deque<Text> ring_;  // ends with the event last_seq_
  std::uint64_t last_seq_ = 0;
  bool ended_ = false;
  std::uint64_t frames_dropped_ = 0;
  std::uint64_t readers_sent_away_ = 0;
  std::vector<std::weak_ptr<Reader>> readers_;
};

}  // namespace armloom
