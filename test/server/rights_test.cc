// Who may what, on a server that asks for tokens: every verb of the table x whoever asks. Nothing
// is permitted that the table does not say.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "server/access/token_file.h"
#include "server/api/route.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

struct Answered {
  int status;
  std::string head;
};

class Rights : public test::RunningServer {
 protected:
  void SetUp() override {
    const fs::path folder = fs::path(::testing::TempDir()) / "armloom-rights" /
                            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder);
    fs::create_directories(folder);
    file_ = folder / "tokens";
    for (const char* name : {"viewer", "operator", "admin", "withdrawn"}) {
      const auto role = role_named(name).value_or(Role::admin);
      tokens_[name] = TokenFile(file_).add(name, role).value();
    }
    ASSERT_TRUE(TokenFile(file_).withdraw("withdrawn"));
    options_.tokens = file_;
    start(1);
  }
  static std::string bearer(const std::string& token) {
    return "Authorization: Bearer " + token + "\r\n";
  }
  // Only the head of the answer: some never end.
  Answered ask(const std::string& method, const std::string& path, const std::string& headers,
               const std::string& body = "", const std::string& host = "127.0.0.1") {
    test::Wire wire(port());
    const bool socket = path.ends_with("/ws");
    wire.send(method + " " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + headers +
              (socket ? "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                      : "") +
              (method == "GET" ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") +
              "\r\n" + body);
    std::string head = wire.take_until("\r\n\r\n");
    return {std::stoi(head.substr(9, 3)), std::move(head)};
  }
  Answered ask(const Route& route, const std::string& headers,
               const std::string& host = "127.0.0.1") {
    std::string path = route.path;
    for (const char* part : {"{id}", "{name}"}) {
      if (const std::size_t at = path.find(part); at != path.npos) {
        path.replace(at, std::string(part).size(), "nothing");
      }
    }
    EXPECT_EQ(path.find('{'), path.npos) << path;
    return ask(route.method, path, headers, "", host);
  }

  fs::path file_;
  std::map<std::string, std::string> tokens_;
};

TEST_F(Rights, AreThoseOfTheTableForEveryVerbAndRole) {
  std::size_t denied = 0, permitted = 0;
  for (const Route& route : all_routes()) {
    const std::string verb = route.method + " " + route.path;
    for (const char* nobody : {"", "withdrawn", "wrong"}) {
      const std::string token = *nobody == '\0' ? "" : bearer(tokens_[nobody] + "x");
      const std::string shown =
          std::string(nobody) == "withdrawn" ? bearer(tokens_[nobody]) : token;
      const Answered answer = ask(route, shown);
      EXPECT_EQ(answer.status == 401, route.role.has_value())
          << verb << " by nobody: " << answer.head;
      if (answer.status == 401) {
        EXPECT_NE(answer.head.find("WWW-Authenticate: Bearer"), std::string::npos);
        ++denied;
      }
    }
    for (const char* name : {"viewer", "operator", "admin"}) {
      const bool may = !route.role || *role_named(name) >= *route.role;
      for (const std::string& header :
           {bearer(tokens_[name]), "Cookie: a=b; armloom_token=" + tokens_[name] + "; c=d\r\n"}) {
        const Answered answer = ask(route, header);
        EXPECT_NE(answer.status, 401) << verb << " by " << name;
        EXPECT_EQ(answer.status == 403, !may) << verb << " by " << name << ": " << answer.head;
        ++(may ? permitted : denied);
      }
    }
  }
  std::printf("%zu denied, %zu permitted\n", denied, permitted);
  EXPECT_GT(denied, 100U);
  EXPECT_GT(permitted, 100U);
}

TEST_F(Rights, AreNoneForPagesOfOtherSitesAndOtherNamesWhateverTheyShow) {
  const std::string admin = bearer(tokens_["admin"]);
  for (const Route& route : all_routes()) {
    const std::string verb = route.method + " " + route.path;
    const Answered page = ask(route, admin + "Origin: http://elsewhere.example\r\n");
    EXPECT_EQ(page.status == 403, route.who == Who::commander) << verb << ": " << page.head;
    const Answered name = ask(route, admin, "elsewhere.example");
    EXPECT_EQ(name.status == 403, route.who != Who::anyone) << verb << ": " << name.head;
  }
}

TEST_F(Rights, TheTableGivesLittleAway) {
  std::set<std::string> open, of_viewers;
  for (const Route& route : all_routes()) {
    if (!route.role) open.insert(route.id);
    const bool changes = route.method != "GET";
    if (changes && route.role == Role::viewer) of_viewers.insert(route.id);
  }
  EXPECT_EQ(open, (std::set<std::string>{"health", "ready", "openapi", "cellSchema", "docs",
                                         "docsStyle", "docsScript", "dashboard", "getSession",
                                         "logIn", "logOut", "loginPage", "loginScript"}));
  EXPECT_EQ(of_viewers, (std::set<std::string>{"checkJob", "planMotion"}))
      << "which change nothing";
}

TEST_F(Rights, AMethodOrPathThatIsNotInTheTableIsNotServed) {
  const std::string admin = bearer(tokens_["admin"]);
  EXPECT_EQ(ask("PUT", "/api/v1/jobs", admin).status, 405);
  EXPECT_EQ(ask("POST", "/api/v1/nothing", admin).status, 404);
  EXPECT_EQ(ask("POST", "/api/v1//stop", "").status, 404);
  EXPECT_EQ(ask("POST", "/api/v1/stop/", "").status, 404);
}

TEST_F(Rights, TokensCountAsSoonAsTheyAreMadeAndNoLongerThanTheyAre) {
  const std::string fresh = TokenFile(file_).add("fresh", Role::operate).value();
  EXPECT_EQ(ask("GET", "/api/v1/arms", bearer(fresh)).status, 200);
  test::Wire events(port());
  events.send("GET /api/v1/events HTTP/1.1\r\nHost: 127.0.0.1\r\n" + bearer(fresh) + "\r\n");
  EXPECT_NE(events.take_until("\r\n\r\n").find("200 OK"), std::string::npos);
  ASSERT_TRUE(TokenFile(file_).withdraw("fresh"));
  EXPECT_EQ(ask("GET", "/api/v1/arms", bearer(fresh)).status, 401);
  EXPECT_NE(events.take_all().find(": the token was withdrawn"), std::string::npos);
  fs::remove(file_);
  EXPECT_EQ(ask("GET", "/api/v1/arms", bearer(tokens_["admin"])).status, 401) << "nobody's";
}

TEST_F(Rights, EachTokenHasIdempotencyKeysOfItsOwn) {
  const auto send = [&](const char* name, const std::string& arm) {
    const std::string body =
        R"({"arm": ")" + arm + R"(", "move_to": {"named": "ready"}, "name": "sent"})";
    return ask("POST", "/api/v1/jobs",
               bearer(tokens_[name]) + "Idempotency-Key: one\r\nContent-Type: application/json\r\n",
               body);
  };
  EXPECT_EQ(send("operator", "left").status, 202);
  EXPECT_EQ(send("operator", "left").status, 200);
  EXPECT_EQ(send("operator", "right").status, 409);
  EXPECT_EQ(send("admin", "right").status, 202);
}

TEST_F(Rights, AWebSocketIsClosedWhenItsTokenIsWithdrawn) {
  test::Wire socket(port());
  socket.send(
      "GET /api/v1/ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\n"
      "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
      "Sec-WebSocket-Version: 13\r\n" +
      bearer(tokens_["viewer"]) + "\r\n");
  EXPECT_NE(socket.take_until("\r\n\r\n").find("101"), std::string::npos);
  ASSERT_TRUE(TokenFile(file_).withdraw("viewer"));
  (void)socket.take_until(std::string("\x03\xf0", 2) + "the token was withdrawn");
}

TEST_F(Rights, TheDashboardAsksPeopleToLogInAndKeepsTheTokenFromScripts) {
  const Answered page = ask("GET", "/", "");
  EXPECT_EQ(page.status, 303);
  EXPECT_NE(page.head.find("Location: /login"), std::string::npos);
  EXPECT_EQ(ask("GET", "/login", "").status, 200);
  const auto wrong = post("/api/v1/session", R"({"token": "armloom_0"})");
  EXPECT_EQ(wrong.status, 401);
  EXPECT_EQ(wrong.headers.count("set-cookie"), 0U);
  const auto entered = post("/api/v1/session", R"({"token": ")" + tokens_["operator"] + "\"}");
  ASSERT_EQ(entered.status, 200) << entered.body;
  EXPECT_EQ(entered.json()["role"], "operator");
  const std::string cookie = entered.headers.at("set-cookie");
  EXPECT_EQ(cookie, "armloom_token=" + tokens_["operator"] + "; Path=/; HttpOnly; SameSite=Strict");
  const std::string shown = "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n";
  EXPECT_NE(ask("GET", "/", shown).status, 303);
  EXPECT_EQ(ask("POST", "/api/v1/stop", shown).status, 202);
  const auto left = test::request(port(), "DELETE", "/api/v1/session");
  EXPECT_EQ(left.status, 204);
  EXPECT_NE(left.headers.at("set-cookie").find("Max-Age=0"), std::string::npos);
}

// With a data folder.
class Audit : public Rights {
 protected:
  void SetUp() override {
    options_.data = fs::path(::testing::TempDir()) / "armloom-audit" /
                    ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(*options_.data);
    Rights::SetUp();
  }
  nlohmann::json entries(const std::string& query, std::size_t fewest) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    for (;;) {
      test::Wire wire(port());
      wire.send("GET /api/v1/audit" + query + " HTTP/1.1\r\nHost: 127.0.0.1\r\n" +
                bearer(tokens_["admin"]) + "\r\n");
      const auto answer = test::read_answer(wire);
      const auto page = answer.json();
      if (answer.status != 200) throw std::runtime_error(answer.body);
      if (page["entries"].size() >= fewest) return page;
      if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error(answer.body);
    }
  }
};

TEST_F(Audit, KnowsWhoWasRefusedBeforeTheBodyWasRead) {
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

TEST_F(Audit, AnAlertIsAcknowledgedByTheTokensNameWhateverTheClientSays) {
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

TEST_F(Audit, SaysWhoDidWhatAndWhoWasNotLet) {
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

TEST_F(Rights, TheFileHoldsNoToken) {
  std::ifstream in(file_);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [name, token] : tokens_) EXPECT_EQ(text.find(token), text.npos) << name;
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Tokens, HaveNamesOfTheirOwnAndAFileThatIsOneIsReadWhole) {
  const fs::path path = fs::path(::testing::TempDir()) / "armloom-tokens";
  fs::remove(path);
  TokenFile file(path);
  EXPECT_EQ(file.read().error().front().slug, "no-tokens");
  EXPECT_TRUE(file.add("a", Role::viewer));
  EXPECT_EQ(file.add("a", Role::admin).error().front().slug, "name-in-use");
  EXPECT_EQ(file.add("a b", Role::admin).error().front().slug, "bad-name");
  EXPECT_EQ(file.withdraw("b").error().front().slug, "no-such-token");
  EXPECT_EQ(file.read()->size(), 1U);
  std::ofstream(path, std::ios::app) << "b admin 1234\n";
  EXPECT_NE(file.read().error().front().detail.find("line 3"), std::string::npos);
}

}  // namespace
}  // namespace armloom
