#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "server/http/message.h"
#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

class Limits : public test::RunningServer {
 protected:
  void expect_problem(const std::string& body, int status, const std::string& pointer,
                      const std::string& says) {
    const auto answer = post("/api/v1/jobs", body);
    EXPECT_EQ(answer.status, status) << answer.body.substr(0, 500);
    const json problem = answer.json();
    EXPECT_EQ(problem["pointer"], pointer) << answer.body.substr(0, 500);
    EXPECT_NE(problem["detail"].get<std::string>().find(says), std::string::npos)
        << answer.body.substr(0, 500);
    EXPECT_EQ(get("/api/v1/jobs").json()["jobs"], json::array());
  }
};

TEST_F(Limits, MillionWaypointsAreRefusedQuickly) {
  start(1.0);
  const auto body = [](std::size_t count) {
    std::string points(2 * count, ',');
    for (std::size_t i = 0; i < points.size(); i += 2) points[i] = '0';
    points.back() = ' ';
    return R"({"trajectory": {"joint_names": ["left_panda_joint1"], "points": [)" + points + "]}}";
  };
  const auto before = Clock::now();
  expect_problem(body(90'000), 413, "/trajectory/points", "90000 waypoints, at most 10000");
  expect_problem(body(1'000'000), 413, "/trajectory/points/100000", "more than 100000 elements");
  EXPECT_LT(Clock::now() - before, std::chrono::seconds(5));
}

TEST_F(Limits, BodyOverEightMegabytesIsRefused) {
  start(1.0);
  const auto answer = post("/api/v1/jobs", std::string(8 * 1024 * 1024 + 1, ' '));
  EXPECT_EQ(answer.status, 413);
  EXPECT_NE(answer.json()["detail"].get<std::string>().find("8 MiB"), std::string::npos);
  EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(Limits, InvalidJsonIsRefusedWithPlaceAndReason) {
  start(1.0);
  expect_problem(R"({"trajectory": )" + std::string(1'000'000, '['), 413,
                 "/trajectory" +
                     [] {
                       std::string zeros;
                       for (int i = 0; i < 31; ++i) zeros += "/0";
                       return zeros;
                     }(),
                 "32");
  expect_problem(R"({"id": "a", "id": "b"})", 400, "/id", "twice");
  expect_problem(std::string("{\"id\": \"a\0b\"}", 13), 400, "", "line 1, column 10");
  expect_problem("{\"id\": \"\xff\xfe\"}", 400, "/id", "line 1");
  expect_problem(R"({"priority": 1e999})", 400, "/priority", "double");
  expect_problem(R"({"priority": 99999999999999999999999999999})", 422, "/priority", "not within");
  json huge = test::move("left", test::kHome, test::kMiddle);
  huge["trajectory"]["points"][1]["time_from_start"] = {{"sec", 1ULL << 40U}, {"nanosec", 0}};
  expect_problem(huge.dump(), 422, "/trajectory/points/1/time_from_start/sec", "1099511627776");
}

TEST(ServiceOptions, ReadTimeoutIsTenSeconds) {
  EXPECT_EQ(ServiceOptions{}.read_time, std::chrono::seconds(10));
  EXPECT_EQ(Site{}.read_time, std::chrono::seconds(10));
}

// Both slow requests run at the same time. Their time limit starts at the first byte.
TEST_F(Limits, SlowHeadersAndBodiesAreCutOff) {
  options_.read_time = std::chrono::seconds(1);
  start(1.0);
  const auto before = Clock::now();
  test::Wire header(port());
  header.send("POST /api/v1/jobs HTTP/1.1\r\nHost: a\r\n");
  test::Wire body(port());
  body.send(
      "POST /api/v1/jobs HTTP/1.1\r\nHost: a\r\nContent-Type: application/json\r\n"
      "Content-Length: 100\r\n\r\n{");
  for (int i = 0; i < 8; ++i) {  // single bytes do not extend the limit
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    header.send("X");
    body.send(" ");
  }
  EXPECT_EQ(get("/healthz").status, 200);
  EXPECT_TRUE(header.take_all().starts_with("HTTP/1.1 408 "));
  EXPECT_TRUE(body.take_all().starts_with("HTTP/1.1 408 "));
  const auto took = Clock::now() - before;
  EXPECT_GT(took, std::chrono::milliseconds(900));
  EXPECT_LT(took, std::chrono::seconds(8));  // generous for a busy machine
}

// Raises the limit of descriptors, because client and server ends of all connections are in this
// process.
void allow_descriptors(rlim_t count) {
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur < count) {
    limit.rlim_cur = limit.rlim_max;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
  }
  ASSERT_GE(limit.rlim_cur, count) << "the system gives too few file descriptors";
}

TEST_F(Limits, IdleConnectionsDoNotAffectOthers) {
  ASSERT_NO_FATAL_FAILURE(allow_descriptors(2'200));
  start(20.0);
  std::vector<std::unique_ptr<test::Wire>> idle;
  for (int i = 0; i < 1'000; ++i) idle.push_back(std::make_unique<test::Wire>(port()));
  // This connection is the last in the accept queue. When it is served, all others are open.
  test::Wire last(port());
  last.send(test::request_text("GET", "/healthz", "", ""));
  ASSERT_EQ(test::read_answer(last).status, 200);
  std::vector<std::unique_ptr<test::Listener>> deaf;  // never read
  for (int i = 0; i < 10; ++i) deaf.push_back(std::make_unique<test::Listener>(port()));
  test::Listener listener(port());
  json job = test::move("left", test::kHome, test::kMiddle);
  job["id"] = "go";
  const auto before = Clock::now();
  ASSERT_EQ(post("/api/v1/jobs", job.dump()).status, 202);
  for (int i = 0; i < 20; ++i) {
    const auto asked = Clock::now();
    EXPECT_EQ(get("/healthz").status, 200);
    EXPECT_LT(Clock::now() - asked, std::chrono::seconds(1));
  }
  until(listener, "go", "succeeded");
  EXPECT_LT(Clock::now() - before, std::chrono::seconds(3));  // 0.15 s on an idle machine
  const json one_more = get("/api/v1/jobs/go").json();
  EXPECT_EQ(one_more["state"], "succeeded");
  // still open, and served
  for (const auto& wire : {std::ref(idle.front()), std::ref(idle.back())}) {
    wire.get()->send(test::request_text("GET", "/healthz", "", ""));
    EXPECT_EQ(test::read_answer(*wire.get()).status, 200);
  }
}

TEST_F(Limits, SubscriberThatNeverReadsIsDisconnected) {
  options_.send_buffer = 4096;
  options_.send_time = std::chrono::milliseconds(300);
  start(1.0);
  for (const std::string& head :
       {std::string("GET /api/v1/ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
                    "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                    "Sec-WebSocket-Version: 13\r\n\r\n"),
        std::string("GET /api/v1/events?poses=1 HTTP/1.1\r\nHost: localhost\r\n\r\n")}) {
    test::Wire deaf(port(), 4096);
    deaf.send(head);
    const auto deadline = Clock::now() + std::chrono::seconds(20);
    while (deaf.send(std::string("\x8a\x80\0\0\0\0", 6))) {
      ASSERT_LT(Clock::now(), deadline) << head;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

// Unfinished bodies of many connections: some are refused for lack of memory, but a stop is served.
TEST_F(Limits, UnfinishedBodiesUseBoundedMemory) {
  options_.memory_max = 4 << 20U;
  start(1.0);
  const std::string head =
      "POST /api/v1/jobs HTTP/1.1\r\nHost: a.localhost\r\nContent-Type: application/json\r\n"
      "Content-Length: 1048576\r\n\r\n";
  std::vector<std::unique_ptr<test::Wire>> held;
  int refused = 0;
  for (int i = 0; i < 8; ++i) {
    held.push_back(std::make_unique<test::Wire>(port()));
    held.back()->send(head + std::string(1'000'000, ' '));
    const auto stopped = post("/api/v1/stop", "");  // the server has read the body by then
    EXPECT_EQ(stopped.status, 202);
  }
  for (const auto& wire : held) {
    wire->send(std::string(1'048'576 - 1'000'000, ' '));
    const int status = test::read_answer(*wire).status;
    EXPECT_TRUE(status == 400 || status == 503) << status;
    refused += status == 503 ? 1 : 0;
  }
  EXPECT_GE(refused, 1);
  EXPECT_LE(refused, 7);
  // the memory is free again
  EXPECT_EQ(post("/api/v1/jobs", std::string(1 << 20U, ' ')).status, 400);
}

// A large body is parsed on another thread, so that the connection strand keeps serving.
TEST_F(Limits, LargeBodyDoesNotDelayOthers) {
  // This client sends requests as fast as they are answered.
  options_.limits.requests = options_.limits.requests_of_all = {1e6, 1e6};
  start(1.0);
  std::string some = "[{}";
  for (int i = 1; i < 50'000; ++i) some += ",{}";
  some += "]";
  const auto lists_of_them = [&some](int count) {
    std::string text = "{\"jobs\": [" + some;
    for (int i = 1; i < count; ++i) text += "," + some;
    return text + "]}";
  };
  // The reader counts these parts: object, member, list, 23 lists of 50,000, and the beginning of
  // the next list.
  const auto refused = post("/api/v1/batches", lists_of_them(50));
  EXPECT_EQ(refused.status, 413);
  EXPECT_EQ(refused.json()["type"], "urn:armloom:problem:too-many-parts");
  EXPECT_EQ(refused.json()["pointer"], "/jobs/23/49973");
  const std::string body = lists_of_them(23);
  std::string members = "{";
  for (int i = 0; i < 20'000; ++i) members += "\"" + std::to_string(i) + "\":0,";
  members += "\"x\":0}";
  EXPECT_EQ(post("/api/v1/jobs", members).json()["type"], "urn:armloom:problem:too-many-members");
  // The longest wait of another client while the body was read, as a share of that time. Takes the
  // best of several attempts, because the machine may be busy.
  double share = 1.0;
  for (int attempt = 0; attempt < 5 && share > 0.5; ++attempt) {
    std::atomic<bool> answered = false;
    const auto begin = Clock::now();
    std::thread reader([&] {
      EXPECT_EQ(post("/api/v1/batches", body).status, 400);
      answered = true;
    });
    Clock::duration longest{};
    while (!answered) {
      const auto asked = Clock::now();
      EXPECT_EQ(get("/healthz").status, 200);
      longest = std::max(longest, Clock::now() - asked);
    }
    reader.join();
    share = std::min(share, std::chrono::duration<double>(longest) / (Clock::now() - begin));
  }
  EXPECT_LT(share, 0.5);
}

}  // namespace
}  // namespace armloom
