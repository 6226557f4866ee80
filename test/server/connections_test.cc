#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <vector>

#include "server/http/reserve.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

using Clock = std::chrono::steady_clock;

class Connections : public test::RunningServer {};

TEST_F(Connections, StopDoesNotWaitForItsBody) {
  for (const char* path : {"/api/v1/stop", "/api/v1/arms/left/stop"}) {
    for (const char* length : {"Content-Length: 30", "Transfer-Encoding: chunked",
                               "Content-Length: 30\r\nExpect: 100-continue"}) {
      start(1.0);
      test::Wire stop(port());
      stop.send(std::string("POST ") + path + " HTTP/1.1\r\nHost: localhost\r\n" + length +
                "\r\n\r\n{");
      const auto stopped = test::read_answer(stop);
      EXPECT_EQ(stopped.status, 400) << path << length;
      EXPECT_EQ(stopped.json()["pointer"], "request body");
      EXPECT_EQ(stopped.headers.at("connection"), "close");
      EXPECT_EQ(get("/api/v1/arms/left").json()["state"], "stopped");
      end();
    }
  }
}

TEST_F(Connections, BeyondTheLimitAreRefusedExceptForStops) {
  options_.connections_max = 5;
  start(1.0);
  std::vector<std::unique_ptr<test::Wire>> held;
  for (int i = 0; i < 5; ++i) held.push_back(std::make_unique<test::Wire>(port()));
  const auto refused = get("/healthz");
  EXPECT_EQ(refused.status, 503);
  EXPECT_EQ(refused.json()["type"], "urn:armloom:problem:too-many-connections");
  EXPECT_EQ(refused.json()["detail"], "5 connections are open, which is the limit");
  EXPECT_EQ(refused.headers.at("retry-after"), "1");
  EXPECT_EQ(refused.headers.at("connection"), "close");
  for (const auto& wire : held) {
    wire->send(test::request_text("GET", "/healthz", "", ""));
    EXPECT_EQ(test::read_answer(*wire).status, 200);
  }
  // A stop is still served, even if its header comes in pieces.
  EXPECT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  test::Wire stop(port());
  stop.send("POST /api/v1/stop HTTP/1.1\r\nHo");
  stop.send("st: localhost\r\nContent-Length: 0\r\n\r\n");
  const auto stopped = test::read_answer(stop);
  EXPECT_EQ(stopped.status, 202);
  EXPECT_EQ(stopped.headers.at("connection"), "close");
  held.back()->send("GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
  (void)held.back()->take_all();
  held.pop_back();
  const auto deadline = Clock::now() + std::chrono::seconds(5);
  while (get("/healthz").status != 200) ASSERT_LT(Clock::now(), deadline);
}

// The reserve is small. Filling it locks no client out, because the oldest connection is dropped.
TEST_F(Connections, StopIsServedWhenTheReserveIsFull) {
  options_.connections_per_client_max = 3;
  start(1.0);
  std::vector<std::unique_ptr<test::Wire>> held;
  held.reserve(103);
  for (int i = 0; i < 3; ++i) held.push_back(std::make_unique<test::Wire>(port()));
  for (int i = 0; i < 100; ++i) {
    held.push_back(std::make_unique<test::Wire>(port()));
    held.back()->send("POST /api/v1/stop HTTP/1.1\r\nHost: loc");
  }
  EXPECT_EQ(post("/api/v1/stop", "").status, 202);
  EXPECT_EQ(get("/api/v1/queue").status, 429);
  EXPECT_EQ(held[3]->take_all(), "") << "the first of the reserve was let go";
  EXPECT_FALSE(held.back()->take_all().empty()) << "and the last is told when its time is over";
  held[0]->send(test::request_text("GET", "/api/v1/queue", "", ""));
  EXPECT_TRUE(test::read_answer(*held[0]).json()["stopped"].get<bool>());
}

TEST_F(Connections, StopIsServedDuringAFloodFromAnotherClient) {
  options_.connections_max = 16;  // plus 4 in the reserve
  start(1.0);
  const auto from = [this](const char* address) {
    return std::make_unique<test::Wire>(port(), 0, address);
  };
  const auto unfinished = [&] {
    auto wire = from("127.0.0.4");
    wire->send("POST /api/v1/sto");
    return wire;
  };
  std::vector<std::unique_ptr<test::Wire>> held;
  held.reserve(116);
  for (int i = 0; i < 16; ++i) held.push_back(unfinished());
  const auto stop = from("127.0.0.1");
  for (int i = 0; i < 100; ++i) held.push_back(unfinished());
  stop->send(test::request_text("POST", "/api/v1/stop", "", ""));
  EXPECT_EQ(test::read_answer(*stop).status, 202);
}

TEST(Reserve, KeepsConnectionsThatAreBeingAnswered) {
  asio::io_context io;
  const auto socket = [&] {
    auto made = std::make_unique<Socket>(io);
    made->open(asio::ip::tcp::v4());
    return made;
  };
  const auto first = socket(), second = socket(), other = socket();
  Reserve reserve(3);
  reserve.fill();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(reserve.make_room());
  Reserve::Place of_first(reserve, *first, "a"), of_other(reserve, *other, "b"),
      of_second(reserve, *second, "a");
  ASSERT_TRUE(of_first.keep(true));
  EXPECT_TRUE(reserve.make_room());
  EXPECT_TRUE(first->is_open());
  EXPECT_FALSE(other->is_open()) << "of two that have as many the older one";
  EXPECT_FALSE(of_other.keep(true));
  EXPECT_TRUE(of_first.keep(false));
  EXPECT_TRUE(reserve.make_room());
  EXPECT_FALSE(first->is_open());
  ASSERT_TRUE(of_second.keep(true));
  EXPECT_FALSE(reserve.make_room()) << "nobody may go";
  EXPECT_TRUE(second->is_open());
}

}  // namespace
}  // namespace armloom
