#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "test/server/token_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class AuditLog : public test::TokenServer {
 protected:
  void SetUp() override {
    options_.data = fs::path(::testing::TempDir()) / "armloom-audit" /
                    ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(*options_.data);
    TokenServer::SetUp();
  }
  nlohmann::json entries(const std::string& query, std::size_t fewest) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    for (;;) {
      test::Wire wire(port());
      wire.send("GET /api/v1/audit-log" + query + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" +
                bearer(tokens_["admin"]) + "\r\n");
      const auto answer = test::read_answer(wire);
      const auto page = answer.json();
      if (answer.status != 200) throw std::runtime_error(answer.body);
      if (page["entries"].size() >= fewest) return page;
      if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error(answer.body);
    }
  }
};

TEST_F(AuditLog, RecordsARefusalBeforeTheBodyIsRead) {
  test::Wire wire(port());
  wire.send(
      "POST /api/v1/jobs HTTP/1.1\r\nHost: 127.0.0.1\r\nExpect: 100-continue\r\n"
      "Content-Length: 100\r\n" +
      bearer(tokens_["viewer"]) + "\r\n");
  EXPECT_NE(wire.take_until("\r\n\r\n").find("403"), std::string::npos);
  const auto entry = entries("", 1)["entries"][0];
  EXPECT_EQ(entry["who"], "viewer");
  EXPECT_EQ(entry["path"], "/api/v1/jobs");
  EXPECT_EQ(entry["status"], 403);
}

TEST_F(AuditLog, RecordsTheTokensNameForAcknowledgements) {
  ASSERT_EQ(ask("POST", "/api/v1/stop", bearer(tokens_["operator"])).status, 202);
  test::Wire wire(port());
  wire.send("GET /api/v1/alerts HTTP/1.1\r\nHost: 127.0.0.1\r\n" + bearer(tokens_["viewer"]) +
            "\r\n");
  const auto id = test::read_answer(wire).json()["alerts"][0]["id"].get<std::string>();
  const std::string body = R"({"ids": [")" + id + R"("], "who": "the boss"})";
  const auto acknowledge = [&](const char* role) {
    test::Wire asking(port());
    asking.send("POST /api/v1/alerts/acknowledge HTTP/1.1\r\nHost: 127.0.0.1\r\n" +
                bearer(tokens_[role]) + "Content-Type: application/json\r\nContent-Length: " +
                std::to_string(body.size()) + "\r\n\r\n" + body);
    return test::read_answer(asking);
  };
  EXPECT_EQ(acknowledge("viewer").status, 403);
  const auto seen = acknowledge("operator");
  ASSERT_EQ(seen.status, 200) << seen.body;
  EXPECT_EQ(seen.json()["alerts"][0]["acknowledged"]["who"], "operator");
  const auto entry = entries("", 3)["entries"][0];
  EXPECT_EQ(entry["who"], "operator");
  EXPECT_EQ(entry["path"], "/api/v1/alerts/acknowledge");
}

TEST_F(AuditLog, RecordsCommandsAndRefusalsButNotReads) {
  ASSERT_EQ(ask("POST", "/api/v1/stop", bearer(tokens_["operator"])).status, 202);
  ASSERT_EQ(ask("GET", "/api/v1/arms", bearer(tokens_["viewer"])).status, 200);
  ASSERT_EQ(ask("POST", "/api/v1/resume", bearer(tokens_["viewer"])).status, 403);
  ASSERT_EQ(ask("GET", "/api/v1/jobs", "").status, 401);
  const auto page = entries("", 3);
  ASSERT_EQ(page["entries"].size(), 3U) << "who only looks is not put down: " << page;
  const auto is = [&](std::size_t i, const nlohmann::json& who, const char* verb, int status) {
    const auto entry = page["entries"][i];
    EXPECT_EQ(entry["who"], who) << entry;
    EXPECT_EQ(entry["method"].get<std::string>() + " " + entry["path"].get<std::string>(), verb);
    EXPECT_EQ(entry["status"], status);
    EXPECT_EQ(entry["from"], "127.0.0.1");
    EXPECT_TRUE(entry["at"].get<std::string>().ends_with("Z"));
  };
  is(0, nullptr, "GET /api/v1/jobs", 401);
  is(1, "viewer", "POST /api/v1/resume", 403);
  is(2, "operator", "POST /api/v1/stop", 202);
  const auto first = entries("?limit=2", 2);
  const auto rest = entries("?limit=2&cursor=" + first["next_cursor"].get<std::string>(), 1);
  EXPECT_EQ(rest["entries"].size(), 1U);
  EXPECT_EQ(rest["entries"][0], page["entries"][2]);
  EXPECT_TRUE(rest["next_cursor"].is_null());
  end();
  start(1);
  EXPECT_EQ(entries("", 3)["entries"], page["entries"]) << "kept";
}

TEST_F(AuditLog, CanBeFilteredByClientRequestAndTime) {
  ask("POST", "/api/v1/stop", bearer(tokens_["operator"]));
  ask("POST", "/api/v1/resume", bearer(tokens_["viewer"]));
  ask("DELETE", "/api/v1/jobs/none", bearer(tokens_["operator"]));
  ask("GET", "/api/v1/jobs", "");
  const json all = entries("", 4)["entries"];
  const auto statuses = [&](const std::string& query) {
    std::string told;
    const json page = entries(query, 0);
    for (const auto& entry : page["entries"]) told += entry["status"].dump() + " ";
    return told;
  };
  EXPECT_EQ(statuses("?who=operator"), "404 202 ");
  EXPECT_EQ(statuses("?who="), "401 ") << "no name was shown";
  EXPECT_EQ(statuses("?who=oper"), "");
  EXPECT_EQ(statuses("?method=POST"), "403 202 ");
  EXPECT_EQ(statuses("?method=post"), "403 202 ");
  EXPECT_EQ(statuses("?path=/api/v1/jobs"), "401 404 ");
  EXPECT_EQ(statuses("?path=/api/v1/jobs&method=DELETE&status=404"), "404 ");
  EXPECT_EQ(statuses("?from=127.0.0.2"), "");
  EXPECT_EQ(statuses("?from=127.0.0.1&status=202"), "202 ");
  const std::string second = all[2]["at"], last = all[0]["at"];
  const json since = entries("?since=" + second, 1), before = entries("?before=" + last, 0);
  for (const auto& entry : since["entries"]) EXPECT_GE(entry["at"], second);
  for (const auto& entry : before["entries"]) EXPECT_LT(entry["at"], last);
  EXPECT_EQ(since["entries"].size() + entries("?before=" + second, 0)["entries"].size(), 4U);
  const auto page = entries("?limit=1&who=operator", 1);
  EXPECT_EQ(statuses("?who=operator&cursor=" + page["next_cursor"].get<std::string>()), "202 ");
  EXPECT_EQ(page["damaged"], 0);
  for (const char* wrong :
       {"?since=yesterday", "?before=1", "?status=1", "?status=x", "?cursor=x", "?limit=1001"}) {
    test::Wire wire(port());
    wire.send(std::string("GET /api/v1/audit-log") + wrong + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" +
              bearer(tokens_["admin"]) + "\r\n");
    const auto refused = test::read_answer(wire);
    EXPECT_EQ(refused.status, 422) << wrong;
    EXPECT_EQ("?" + refused.json()["pointer"].get<std::string>().substr(1),
              std::string(wrong).substr(0, std::string(wrong).find('=')));
  }
}

}  // namespace
}  // namespace armloom
