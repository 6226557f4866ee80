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

TEST_F(EventFeed, BeginsWithASnapshotAndContinuesWithoutAHole) {
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

TEST_F(EventFeed, ResumesWhereAReaderWas) {
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

TEST_F(EventFeed, GivesASnapshotWithAGapToAReaderOfAnotherRun) {
  start(1.0);
  for (const char* query : {"?stream=00000000-0000-4000-8000-000000000000&since=0", "?since=x",
                            "?stream=&since=99999"}) {
    test::Listener listener(port(), query);
    const json first = listener.next_event();
    EXPECT_EQ(first["type"], "snapshot");
    EXPECT_EQ(first["data"]["gap"], true) << query;
  }
}

TEST_F(EventFeed, IsClosedToPagesOfOtherSites) {
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
