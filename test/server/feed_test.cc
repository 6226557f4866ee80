#include <gtest/gtest.h>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;

class EventFeed : public test::RunningServer {
 protected:
  void run_one_job() {
    json job = test::move("left", test::kHome, test::kMiddle);
    job["id"] = "go";
    ASSERT_EQ(post("/api/v1/jobs", job.dump()).status, 202);
  }
  static bool ends_go(const json& message) {
    return message["type"] == "job" && !message["data"]["result"].is_null();
  }
};

TEST_F(EventFeed, StartsWithASnapshotAndHasNoGaps) {
  start(20.0);
  run_one_job();
  test::Listener listener(port());
  const json snapshot = listener.next_event();
  ASSERT_EQ(snapshot["type"], "snapshot");
  EXPECT_EQ(snapshot["data"]["cell"], "two_pandas");
  EXPECT_EQ(snapshot["data"]["arms"].size(), 2U);
  EXPECT_EQ(snapshot["data"]["jobs"][0]["id"], "go");
  EXPECT_FALSE(snapshot["data"].contains("gap"));
  std::uint64_t seq = snapshot["seq"];
  for (;;) {
    const json event = listener.next_event();
    EXPECT_EQ(event["seq"], ++seq);
    EXPECT_EQ(event["stream"], snapshot["stream"]);
    if (ends_go(event)) break;
  }
}

TEST_F(EventFeed, ShowsPosesOfEveryJoint) {
  start(1.0);
  test::Listener listener(port());
  const json frame = listener.next_of("state");
  EXPECT_FALSE(frame.contains("seq"));
  EXPECT_EQ(frame["q"].size(), 16U);
  EXPECT_EQ(frame["q"]["left_panda_joint4"], -2.6);
}

TEST_F(EventFeed, ResumesWhereASubscriberLeft) {
  start(20.0);
  std::vector<json> all;
  std::string stream;
  std::uint64_t first = 0;
  {
    test::Listener listener(port());
    const json snapshot = listener.next_event();
    stream = snapshot["stream"];
    first = snapshot["seq"];
    run_one_job();
    do {
      all.push_back(listener.next_event());
    } while (!ends_go(all.back()));
  }
  test::Listener again(port(), "?stream=" + stream + "&since=" + std::to_string(first));
  for (const json& event : all) EXPECT_EQ(again.next_event(), event);
}

TEST_F(EventFeed, ReportsAGapToSubscribersOfAnotherSession) {
  start(1.0);
  for (const char* query : {"?stream=00000000-0000-4000-8000-000000000000&since=0", "?since=0",
                            "?stream=&since=99999"}) {
    test::Listener listener(port(), query);
    const json first = listener.next_event();
    EXPECT_EQ(first["type"], "snapshot");
    EXPECT_EQ(first["data"]["gap"], true) << query;
  }
}

// A Server-Sent Event: id and data.
struct SentEvent {
  std::string id;
  json data;
};
SentEvent next_sent(test::Wire& wire) {
  SentEvent event;
  for (;;) {
    std::string line = wire.take_until("\n");
    line.pop_back();
    if (line.empty() && !event.data.is_null()) return event;
    if (line.starts_with("id: ")) event.id = line.substr(4);
    if (line.starts_with("data: ")) event.data = json::parse(line.substr(6));
  }
}

TEST_F(EventFeed, ServesServerSentEventsAndResumesByLastEventId) {
  start(20.0);
  const std::string get_events = "GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n";
  std::vector<SentEvent> all;
  {
    test::Wire wire(port());
    wire.send(get_events + "\r\n");
    const std::string head = wire.take_until("\r\n\r\n");
    EXPECT_TRUE(head.starts_with("HTTP/1.1 200")) << head;
    EXPECT_NE(head.find("text/event-stream"), std::string::npos) << head;
    all.push_back(next_sent(wire));
    run_one_job();
    while (!ends_go(all.back().data)) all.push_back(next_sent(wire));
  }
  EXPECT_EQ(all.front().data["type"], "snapshot");
  for (const SentEvent& event : all) {
    EXPECT_EQ(event.id, event.data["stream"].get<std::string>() + ":" +
                            std::to_string(event.data["seq"].get<std::uint64_t>()));
    EXPECT_NE(event.data["type"], "state");  // pose frames only on request
  }
  test::Wire again(port());
  again.send(get_events + "Last-Event-ID: " + all.front().id + "\r\n\r\n");
  (void)again.take_until("\r\n\r\n");
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_EQ(next_sent(again).data, all[i].data);

  test::Wire stranger(port());
  stranger.send(get_events + "Last-Event-ID: nonsense\r\n\r\n");
  (void)stranger.take_until("\r\n\r\n");
  EXPECT_EQ(next_sent(stranger).data["data"]["gap"], true);
}

// Pose frames, which this subscriber does not get, must not delay the comment.
TEST_F(EventFeed, SendsKeepAliveComments) {
  options_.keep_alive = std::chrono::milliseconds(200);
  start(1.0);
  test::Wire wire(port());
  wire.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  (void)wire.take_until("\r\n\r\n");
  EXPECT_EQ(next_sent(wire).data["type"], "snapshot");
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(wire.take_until("\n\n"), ": keep-alive\n\n");
  EXPECT_EQ(wire.take_until("\n\n"), ": keep-alive\n\n");
  const auto took = std::chrono::steady_clock::now() - before;
  EXPECT_GT(took, std::chrono::milliseconds(350));
  run_one_job();
  EXPECT_EQ(next_sent(wire).data["type"], "job");
}

// send_time bounds one event, not the whole stream.
TEST_F(EventFeed, StaysOpenLongerThanTheSendTimeout) {
  options_.keep_alive = std::chrono::milliseconds(50);
  options_.send_time = std::chrono::milliseconds(100);
  start(1.0);
  test::Wire wire(port());
  wire.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  (void)wire.take_until("\r\n\r\n");
  EXPECT_EQ(next_sent(wire).data["type"], "snapshot");
  for (int i = 0; i < 10; ++i) EXPECT_EQ(wire.take_until("\n\n"), ": keep-alive\n\n");
}

TEST_F(EventFeed, ServesPosesAsServerSentEventsOnRequest) {
  start(1.0);
  test::Wire wire(port());
  wire.send("GET /api/v1/events?poses=1 HTTP/1.1\r\nHost: localhost\r\n\r\n");
  (void)wire.take_until("\r\n\r\n");
  EXPECT_EQ(next_sent(wire).data["type"], "snapshot");
  const SentEvent frame = next_sent(wire);
  EXPECT_EQ(frame.data["type"], "state");
  EXPECT_EQ(frame.id, "");
  EXPECT_EQ(test::request(port(), "HEAD", "/api/v1/events").status, 200);
  EXPECT_EQ(test::request(port(), "POST", "/api/v1/events", "{}").status, 405);
}

TEST_F(EventFeed, RefusesOtherOrigins) {
  start(1.0);
  test::Wire wire(port());
  wire.send(
      "GET /api/v1/ws HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n"
      "Upgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
  EXPECT_EQ(test::read_answer(wire).status, 403);
}

}  // namespace
}  // namespace armloom
