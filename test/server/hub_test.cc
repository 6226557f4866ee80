#include "server/hub/hub.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace armloom {
namespace {

Hub::Text text(const std::string& content) { return std::make_shared<const std::string>(content); }

void publish(Hub& hub, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t seq = from; seq <= to; ++seq) hub.publish(seq, text(std::to_string(seq)));
}

std::string read_all(Subscription& subscription) {
  std::string all;
  while (const auto message = subscription.next()) all += *message->text + " ";
  return all;
}

TEST(Hub, ServesEachSubscriberInOrderAtItsOwnPace) {
  Hub hub;
  publish(hub, 1, 3);
  const SubscriptionPtr early = hub.resume(1);
  const SubscriptionPtr late = hub.resume(3, text("snapshot"));
  publish(hub, 4, 5);
  EXPECT_EQ(read_all(*early), "2 3 4 5 ");
  EXPECT_EQ(read_all(*late), "snapshot 4 5 ");
  EXPECT_EQ(read_all(*late), "");
}

TEST(Hub, DeliversOnlyTheNewestFrameAfterAllEvents) {
  Hub hub;
  const SubscriptionPtr subscription = hub.resume(0);
  hub.publish_frame(text("old"));
  hub.publish_frame(text("new"));
  publish(hub, 1, 1);
  EXPECT_EQ(read_all(*subscription), "1 new ");
}

TEST(Hub, NotifiesSubscribers) {
  Hub hub;
  const SubscriptionPtr subscription = hub.resume(0);
  int news = 0;
  subscription->on_news([&] { ++news; });
  publish(hub, 1, 1);
  hub.publish_frame(text("frame"));
  EXPECT_EQ(news, 2);
}

TEST(Hub, ResumesOnlyFromKeptEvents) {
  Hub hub(10);
  publish(hub, 1, 15);
  EXPECT_TRUE(hub.resume(5));
  EXPECT_FALSE(hub.resume(4));
  EXPECT_TRUE(hub.resume(15));
  EXPECT_FALSE(hub.resume(16));
}

TEST(Hub, DisconnectsASlowSubscriberWithAReason) {
  Hub hub(10);
  const SubscriptionPtr subscription = hub.resume(0);
  publish(hub, 1, 10);
  EXPECT_FALSE(subscription->close_reason());
  publish(hub, 11, 11);
  ASSERT_TRUE(subscription->close_reason());
  EXPECT_EQ(subscription->close_reason()->why, CloseReason::Why::too_slow);
  EXPECT_EQ(subscription->close_reason()->text, "too slow: 11 events behind, 10 are kept");
  EXPECT_FALSE(subscription->next());
}

TEST(Hub, DisconnectsASubscriberTooManyBytesBehind) {
  Hub hub(1000, 100);
  const SubscriptionPtr subscription = hub.resume(0);
  for (std::uint64_t seq = 1; seq <= 4; ++seq) hub.publish(seq, text(std::string(25, 'e')));
  EXPECT_FALSE(subscription->close_reason());
  hub.publish(5, text("e"));
  ASSERT_TRUE(subscription->close_reason());
  EXPECT_EQ(subscription->close_reason()->why, CloseReason::Why::too_slow);
  // A single event is kept, however large.
  hub.publish(6, text(std::string(200, 'e')));
  EXPECT_TRUE(hub.resume(5)->next());
}

TEST(Hub, NumbersEventsAndSnapshotsButNotFrames) {
  Hub hub;
  publish(hub, 1, 3);
  const SubscriptionPtr subscription = hub.resume(2, text("snapshot"));
  hub.publish_frame(text("frame"));
  EXPECT_EQ(subscription->next()->seq, 2U);
  EXPECT_EQ(subscription->next()->seq, 3U);
  EXPECT_EQ(subscription->next()->seq, std::nullopt);
}

TEST(Hub, DisconnectsAllSubscribersAtTheEnd) {
  Hub hub;
  const SubscriptionPtr subscription = hub.resume(0);
  int news = 0;
  subscription->on_news([&] { ++news; });
  hub.end();
  EXPECT_EQ(news, 1);
  ASSERT_TRUE(subscription->close_reason());
  EXPECT_EQ(subscription->close_reason()->why, CloseReason::Why::server_ends);
}

TEST(Hub, DeliversAllEventsBeforeTheFinalClose) {
  Hub hub;
  const SubscriptionPtr subscription = hub.resume(0, text("snapshot"));
  publish(hub, 1, 2);
  hub.end();
  for (int message = 0; message < 3; ++message) {
    EXPECT_FALSE(subscription->close_reason());
    EXPECT_TRUE(subscription->next());
  }
  ASSERT_TRUE(subscription->close_reason());
  EXPECT_EQ(subscription->close_reason()->why, CloseReason::Why::server_ends);
}

TEST(Hub, RefusesAGapInTheLog) {
  Hub hub;
  publish(hub, 1, 1);
  EXPECT_THROW(hub.publish(3, text("3")), std::logic_error);
}

TEST(Hub, ForgetsSubscribersThatAreGone) {
  Hub hub;
  SubscriptionPtr subscription = hub.resume(0);
  EXPECT_EQ(hub.readers(), 1U);
  subscription.reset();
  EXPECT_EQ(hub.readers(), 0U);
}

}  // namespace
}  // namespace armloom
