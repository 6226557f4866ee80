#include "server/http/client_limits.h"

#include "server/access/token_file.h"
#include "test/server/verbs_fixture.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const ClientLimits::Time kStart{};

ClientLimits::Options few() {
  return {
      .requests = {2, 4}, .requests_of_all = {10, 5}, .jobs = {10, 100}, .jobs_of_all = {10, 150}};
}

TEST(ClientLimits, AllowABurstAndThenTheRate) {
  ClientLimits limits(few(), kStart);
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(limits.request("a", kStart)) << i;
  const auto refused = limits.request("a", kStart);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status, 429);
  EXPECT_EQ(refused->detail, "one client may send 2 requests a second, 4 at once");
  EXPECT_EQ(refused->headers.front(), std::pair(std::string("Retry-After"), std::string("1")));
  EXPECT_TRUE(limits.request("a", kStart + 499ms));
  EXPECT_FALSE(limits.request("a", kStart + 500ms));
  EXPECT_TRUE(limits.request("a", kStart + 501ms));
}

TEST(ClientLimits, CountEachClientSeparately) {
  ClientLimits limits(few(), kStart);
  for (int i = 0; i < 5; ++i) (void)limits.request("a", kStart);
  EXPECT_FALSE(limits.request("b", kStart));
  const auto refused = limits.request("b", kStart);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->detail, "all clients together may send 10 requests a second, 5 at once");
}

TEST(ClientLimits, AllowABatchBeyondTheBurstAfterAPause) {
  ClientLimits limits(few(), kStart);
  EXPECT_FALSE(limits.jobs("a", 120, kStart)) << "more than 100, but nothing was taken before";
  EXPECT_TRUE(limits.jobs("a", 1, kStart + 1s));
  const auto refused = limits.jobs("a", 50, kStart + 2s);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->headers.front().second, "5") << "20 were too many, 50 are wanted";
  EXPECT_FALSE(limits.jobs("a", 50, kStart + 7s));
}

TEST(ClientLimits, ForgetIdleClients) {
  ClientLimits limits(few(), kStart);
  for (int i = 0; i < 1000; ++i) {
    (void)limits.request("client " + std::to_string(i), kStart + i * 100ms);
  }
  EXPECT_LT(limits.clients(), 250U);
}

class Limited : public test::VerbsFixture {};

TEST_F(Limited, StopIsNeverLimited) {
  options_.limits.requests = {0.01, 3};
  start(1.0);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(get("/api/v1/arms").status, 200);
  const auto refused = get("/api/v1/arms");
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(refused.headers.at("content-type"), "application/problem+json");
  EXPECT_GT(std::stoi(refused.headers.at("retry-after")), 1);
  EXPECT_EQ(get("/nothing").status, 429);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(post("/api/v1/stop", "").status, 202);
    EXPECT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  }
  EXPECT_EQ(post("/api/v1/resume", "").status, 429);
  EXPECT_EQ(get("/healthz").status, 200) << "a probe is not to blame for who else asks from there";
  EXPECT_EQ(get("/readyz").status, 200);
}

TEST_F(Limited, ClientsAreDistinguishedByToken) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "armloom-limited-tokens";
  std::filesystem::remove(file);
  const std::string one = TokenFile(file).add("one", Role::operate).value();
  const std::string two = TokenFile(file).add("two", Role::operate).value();
  options_.tokens = file;
  options_.limits.requests = {0.01, 3};
  start(1.0);
  const auto ask = [&](const std::string& token) {
    test::Wire wire(port());
    wire.send("GET /api/v1/arms HTTP/1.1\r\nHost: 127.0.0.1\r\nAuthorization: Bearer " + token +
              "\r\n\r\n");
    return test::read_answer(wire).status;
  };
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ask(one), 200);
  EXPECT_EQ(ask(one), 429);
  EXPECT_EQ(ask(two), 200);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(ask("wrong"), 401) << "whoever has none is its address";
  EXPECT_EQ(ask("another"), 429);
}

TEST_F(Limited, BatchCountsEachJob) {
  options_.limits.jobs = {0.01, 3};
  start(1.0);
  json batch{{"jobs", json::array()}};
  for (int i = 0; i < 2; ++i) {
    const bool there = i % 2 == 0;
    batch["jobs"].push_back(job("j" + std::to_string(i), there ? test::kHome : test::kAside,
                                there ? test::kAside : test::kHome));
  }
  ASSERT_EQ(post("/api/v1/batches", batch.dump()).status, 202);
  const auto refused = post("/api/v1/batches", batch.dump());
  EXPECT_EQ(refused.status, 429) << refused.body;
  EXPECT_EQ(post("/api/v1/jobs", job("k", test::kHome, test::kAside, "right").dump()).status, 202);
  EXPECT_EQ(post("/api/v1/jobs", job("l", test::kAside, test::kHome, "right").dump()).status, 429);
  const std::string metrics = get("/metrics").body;
  EXPECT_NE(metrics.find("armloom_limited_total{what=\"jobs\"} 2"), std::string::npos) << metrics;
}

TEST_F(Limited, ConnectionsPerAddressAreBounded) {
  options_.connections_per_client_max = 2;
  start(1.0);
  const auto one = std::make_unique<test::Wire>(port());
  one->send("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  EXPECT_EQ(test::read_answer(*one).status, 200);
  auto two = std::make_unique<test::Wire>(port());
  two->send("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  EXPECT_EQ(test::read_answer(*two).status, 200);
  test::Wire three(port());
  const auto refused = test::read_answer(three);
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(refused.json()["value"], "127.0.0.1");
  EXPECT_EQ(refused.headers.at("retry-after"), "1");
  two.reset();
  for (int status = 0; status != 200;) {  // until the server has noticed the closed connection
    test::Wire next(port());
    next.send("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    status = test::read_answer(next).status;
  }
}

}  // namespace
}  // namespace armloom
