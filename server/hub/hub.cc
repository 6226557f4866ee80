#include "server/hub/hub.h"

#include <stdexcept>
#include <utility>

namespace armloom {

class Hub::Reader final : public Subscription {
 public:
  Reader(const Hub& hub, std::uint64_t since, Text first)
      : hub_(hub), read_(since), first_(std::move(first)) {}

  std::optional<Message> next() override {
    if (first_) return Message{std::exchange(first_, nullptr), read_};
    if (behind() > hub_.ring_.size()) return std::nullopt;
    if (behind() > 0) {
      const Text event = hub_.ring_[hub_.ring_.size() - behind()];
      return Message{event, ++read_};
    }
    if (frame_) return Message{std::exchange(frame_, nullptr), std::nullopt};
    return std::nullopt;
  }

  std::optional<CloseReason> close_reason() const override {
    const bool has_read_all = !first_ && behind() == 0;
    if (hub_.ended_ && has_read_all) {
      return CloseReason{CloseReason::Why::server_ends, "the server ends"};
    }
    if (!is_too_slow()) return std::nullopt;
    return CloseReason{CloseReason::Why::too_slow,
                       "too slow: " + std::to_string(behind()) + " events behind, " +
                           std::to_string(hub_.ring_.size()) + " are kept"};
  }

  void on_news(std::function<void()> call) override { news_ = std::move(call); }

  // Replaces the frame to send next. Returns true if the previous frame had been sent.
  bool offer(const Text& frame) { return std::exchange(frame_, frame) == nullptr; }
  // Returns true on the first call after the subscriber has fallen too far behind.
  bool falls_behind() { return is_too_slow() && !std::exchange(fallen_, true); }
  void tell() {
    if (news_) news_();
  }

 private:
  bool is_too_slow() const { return !first_ && behind() > hub_.ring_.size(); }
  std::size_t behind() const { return static_cast<std::size_t>(hub_.last_seq_ - read_); }

  const Hub& hub_;  // the hub exists during each call, but a subscriber may outlive it
  std::uint64_t read_;
  Text first_;
  Text frame_;
  bool fallen_ = false;
  std::function<void()> news_;
};

void Hub::publish(std::uint64_t seq, Text event) {
  if (seq != last_seq_ + 1) throw std::logic_error("the event log has a hole");
  last_seq_ = seq;
  bytes_ += event->size();
  ring_.push_back(std::move(event));
  while (ring_.size() > capacity_ || (bytes_ > bytes_max_ && ring_.size() > 1)) {
    bytes_ -= ring_.front()->size();
    ring_.pop_front();
  }
  tell_readers();
}

void Hub::publish_frame(Text frame) {
  for (const auto& weak : readers_) {
    const auto reader = weak.lock();
    if (reader && !reader->offer(frame)) ++frames_dropped_;
  }
  tell_readers();
}

void Hub::end() {
  ended_ = true;
  tell_readers();
}

SubscriptionPtr Hub::resume(std::uint64_t since, Text first) {
  if (since > last_seq_ || last_seq_ - since > ring_.size()) return nullptr;
  const auto reader = std::make_shared<Reader>(*this, since, std::move(first));
  readers_.push_back(reader);
  return reader;
}

std::size_t Hub::readers() {
  std::erase_if(readers_, [](const auto& weak) { return weak.expired(); });
  return readers_.size();
}

void Hub::tell_readers() {
  std::erase_if(readers_, [](const auto& weak) { return weak.expired(); });
  for (const auto& weak : readers_) {
    const auto reader = weak.lock();
    if (!reader) continue;
    if (reader->falls_behind()) ++subscribers_disconnected_;
    reader->tell();
  }
}

}  // namespace armloom
