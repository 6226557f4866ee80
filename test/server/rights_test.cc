#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "core/base/enumeration.h"
#include "test/server/token_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

class Rights : public test::TokenServer {};

TEST_F(Rights, MatchTheRouteTableForEveryRole) {
  std::size_t denied = 0, permitted = 0;
  for (const Route& route : all_routes()) {
    const std::string verb = route.method + " " + route.path;
    for (const char* nobody : {"", "revoked", "wrong"}) {
      const std::string token = *nobody == '\0' ? "" : bearer(tokens_[nobody] + "x");
      const std::string shown = std::string(nobody) == "revoked" ? bearer(tokens_[nobody]) : token;
      const test::Answered answer = ask(route, shown);
      EXPECT_EQ(answer.status == 401, route.role.has_value())
          << verb << " by nobody: " << answer.head;
      if (answer.status == 401) {
        EXPECT_NE(answer.head.find("WWW-Authenticate: Bearer"), std::string::npos);
        ++denied;
      }
    }
    for (const char* name : {"viewer", "operator", "admin"}) {
      const bool may = !route.role || *value_named<Role>(name) >= *route.role;
      for (const std::string& header :
           {bearer(tokens_[name]), "Cookie: a=b; armloom_token=" + tokens_[name] + "; c=d\r\n"}) {
        const test::Answered answer = ask(route, header);
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

TEST_F(Rights, AreDeniedToOtherOriginsAndHosts) {
  const std::string admin = bearer(tokens_["admin"]);
  for (const Route& route : all_routes()) {
    const std::string verb = route.method + " " + route.path;
    const test::Answered page = ask(route, admin + "Origin: http://elsewhere.example\r\n");
    EXPECT_EQ(page.status == 403, route.who == Who::commander) << verb << ": " << page.head;
    const test::Answered name = ask(route, admin, "elsewhere.example");
    EXPECT_EQ(name.status == 403, route.who != Who::anyone) << verb << ": " << name.head;
  }
}

TEST_F(Rights, AreMinimalWithoutATokenAndForViewers) {
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

TEST_F(Rights, ExistOnlyForListedMethodsAndPaths) {
  const std::string admin = bearer(tokens_["admin"]);
  EXPECT_EQ(ask("PUT", "/api/v1/jobs", admin).status, 405);
  EXPECT_EQ(ask("POST", "/api/v1/nothing", admin).status, 404);
  EXPECT_EQ(ask("POST", "/api/v1//stop", "").status, 404);
  EXPECT_EQ(ask("POST", "/api/v1/stop/", "").status, 404);
}

TEST_F(Rights, FollowChangesOfTheTokenFileAtOnce) {
  const std::string fresh = TokenFile(file_).add("fresh", Role::operate).value();
  EXPECT_EQ(ask("GET", "/api/v1/arms", bearer(fresh)).status, 200);
  test::Wire events(port());
  events.send("GET /api/v1/events HTTP/1.1\r\nHost: 127.0.0.1\r\n" + bearer(fresh) + "\r\n");
  EXPECT_NE(events.take_until("\r\n\r\n").find("200 OK"), std::string::npos);
  ASSERT_TRUE(TokenFile(file_).revoke("fresh"));
  EXPECT_EQ(ask("GET", "/api/v1/arms", bearer(fresh)).status, 401);
  EXPECT_NE(events.take_all().find(": the token was revoked"), std::string::npos);
  fs::remove(file_);
  EXPECT_EQ(ask("GET", "/api/v1/arms", bearer(tokens_["admin"])).status, 401) << "nobody's";
}

// An editing mistake in the token file must not lock any operator out of Stop.
TEST_F(Rights, SurviveAnInvalidTokenFileWithAReport) {
  const std::uintmax_t size = fs::file_size(file_);
  EXPECT_EQ(ask("GET", "/readyz", "").status, 200);
  std::ofstream(file_, std::ios::app) << "a slip\n";
  EXPECT_EQ(ask("POST", "/api/v1/stop", bearer(tokens_["operator"])).status, 202);
  EXPECT_EQ(ask("POST", "/api/v1/stop", bearer(tokens_["revoked"])).status, 401);
  const auto ready = get("/readyz");
  EXPECT_EQ(ready.status, 503);
  EXPECT_EQ(ready.json()["type"], "urn:armloom:problem:tokens-unreadable");
  fs::resize_file(file_, size);
  EXPECT_EQ(ask("GET", "/readyz", "").status, 200);
  EXPECT_EQ(ask("POST", "/api/v1/stop", bearer(tokens_["operator"])).status, 202);
}

TEST_F(Rights, ControlEndsWithItsToken) {
  const std::string fresh = TokenFile(file_).add("fresh", Role::operate).value();
  const std::string as_json = "Content-Type: application/json\r\n";
  const std::string admin = bearer(tokens_["admin"]);
  EXPECT_EQ(ask("POST", "/api/v1/control", bearer(fresh) + as_json, "{}").status, 200);
  EXPECT_EQ(ask("POST", "/api/v1/control", admin + as_json, "{}").status, 409);
  ASSERT_TRUE(TokenFile(file_).revoke("fresh"));
  EXPECT_EQ(ask("POST", "/api/v1/control", admin + as_json, "{}").status, 200);
}

TEST_F(Rights, RefusalsHaveAWwwAuthenticateHeader) {
  const auto answer =
      ask("POST", "/api/v1/session", "Content-Type: application/json\r\n", R"({"token": "x"})");
  EXPECT_EQ(answer.status, 401);
  EXPECT_NE(answer.head.find("WWW-Authenticate: Bearer"), std::string::npos) << answer.head;
  // Any number of spaces is allowed (RFC 9110, 11.4).
  const std::string spaced = "Authorization: Bearer   " + tokens_["viewer"] + "\r\n";
  EXPECT_EQ(ask("GET", "/api/v1/arms", spaced).status, 200);
  EXPECT_EQ(ask("GET", "/api/v1/arms", "Authorization: Bearer   \r\n").status, 401);
}

TEST_F(Rights, IdempotencyKeysAreScopedToTheToken) {
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

TEST_F(Rights, WebSocketIsClosedWhenItsTokenIsRevoked) {
  test::Wire socket(port());
  socket.send(
      "GET /api/v1/ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\n"
      "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
      "Sec-WebSocket-Version: 13\r\n" +
      bearer(tokens_["viewer"]) + "\r\n");
  EXPECT_NE(socket.take_until("\r\n\r\n").find("101"), std::string::npos);
  ASSERT_TRUE(TokenFile(file_).revoke("viewer"));
  (void)socket.take_until(std::string("\x03\xf0", 2) + "the token was revoked");
}

TEST_F(Rights, DashboardRequiresLogInAndHidesTheTokenFromScripts) {
  const test::Answered page = ask("GET", "/", "");
  EXPECT_EQ(page.status, 303);
  EXPECT_NE(page.head.find("Location: login"), std::string::npos);
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

TEST_F(Rights, TokenFileHasNoPlainTokens) {
  std::ifstream in(file_);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [name, token] : tokens_) EXPECT_EQ(text.find(token), text.npos) << name;
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Tokens, HaveUniqueNamesAndAFileThatIsReadWhole) {
  const fs::path path = fs::path(::testing::TempDir()) / "armloom-tokens";
  fs::remove(path);
  TokenFile file(path);
  EXPECT_EQ(file.read().error().front().slug, "no-tokens");
  EXPECT_TRUE(file.add("a", Role::viewer));
  EXPECT_EQ(file.add("a", Role::admin).error().front().slug, "name-in-use");
  EXPECT_EQ(file.add("a b", Role::admin).error().front().slug, "bad-name");
  EXPECT_EQ(file.revoke("b").error().front().slug, "no-such-token");
  EXPECT_EQ(file.read()->size(), 1U);
  std::ofstream(path, std::ios::app) << "b admin 1234\n";
  EXPECT_NE(file.read().error().front().detail.find("line 3"), std::string::npos);
}

}  // namespace
}  // namespace armloom
