#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Routes : public test::RunningServer {};

TEST_F(Routes, DescribeTheCell) {
  start(1.0);
  EXPECT_EQ(get("/healthz").json()["status"], "ok");
  EXPECT_EQ(get("/readyz").json()["ready"], true);
  const json cell = get("/api/v1/cell").json();
  EXPECT_EQ(cell["name"], "two_pandas");
  EXPECT_EQ(cell["robots"].size(), 2U);
  EXPECT_EQ(get("/api/v1/scene").json()["objects"][0]["name"], "table");
  const json arms = get("/api/v1/arms").json()["arms"];
  ASSERT_EQ(arms.size(), 2U);
  EXPECT_EQ(arms[0]["state"], "idle");
  EXPECT_EQ(get("/api/v1/arms/right").json()["name"], "right");
  const json queue = get("/api/v1/queue").json();
  EXPECT_EQ(queue["policy"], "earliest_start");
  EXPECT_EQ(queue["running"], json::array());
}

TEST_F(Routes, AnswerUnknownResourcesWithAProblem) {
  start(1.0);
  const auto unknown_arm = get("/api/v1/arms/middle");
  EXPECT_EQ(unknown_arm.status, 404);
  EXPECT_EQ(unknown_arm.headers.at("content-type"), "application/problem+json");
  EXPECT_EQ(unknown_arm.json()["value"], "middle");
  EXPECT_EQ(get("/api/v1/nothing").status, 404);
  EXPECT_EQ(get("/api/v1/jobs/").status, 404);
  const auto wrong_method = test::request(port(), "PATCH", "/api/v1/jobs");
  EXPECT_EQ(wrong_method.status, 405);
  EXPECT_EQ(wrong_method.headers.at("allow"), "GET, HEAD, OPTIONS, POST");
  EXPECT_EQ(test::request(port(), "DELETE", "/").status, 405);
  EXPECT_EQ(get("/api/v1/ws").status, 426);
  EXPECT_EQ(get("/api/v1/jobs/a%2fb").status, 400);
}

TEST_F(Routes, HeadHasTheHeadersOfGetAndNoBody) {
  start(1.0);
  const auto whole = get("/api/v1/cell");
  const auto head = test::request(port(), "HEAD", "/api/v1/cell");
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(head.headers.at("content-length"), std::to_string(whole.body.size()));
}

TEST_F(Routes, RefuseInvalidFilters) {
  start(1.0);
  for (const char* query :
       {"?state=lost", "?arm=middle", "?limit=0", "?limit=1001", "?limit=x", "?cursor=-1"}) {
    const auto answer = get(std::string("/api/v1/jobs") + query);
    EXPECT_EQ(answer.status, 422) << query;
    EXPECT_EQ(answer.json()["pointer"].get<std::string>().front(), '?');
  }
}

TEST_F(Routes, RefuseUnknownAndRepeatedParametersByName) {
  start(1.0);
  const std::pair<const char*, const char*> cases[] = {
      {"/jobs?sort=up", "?sort"},      {"/jobs?limit=1&limit=2", "?limit"},
      {"/arms?foo=1", "?foo"},         {"/events?foo=1", "?foo"},
      {"/events?since=abc", "?since"}, {"/events?poses=2", "?poses"},
      {"/ws?poses=1", "?poses"},       {"/ws?since=", "?since"}};
  for (const auto& [target, pointer] : cases) {
    const auto answer = get(std::string("/api/v1") + target);
    EXPECT_EQ(answer.status, 400) << target;
    EXPECT_EQ(answer.json()["pointer"], pointer) << answer.body;
  }
  EXPECT_EQ(get("/api/v1/events?since=abc").json()["value"], "abc");
}

TEST_F(Routes, RefuseBodiesThatAreEncodedOrNotInUtf8) {
  start(1.0);
  for (const char* type : {"application/json; charset=latin1", "text/plain",
                           "application/json; charset=utf-16; charset=utf-8"}) {
    const auto answer = post("/api/v1/jobs", "{}", type);
    EXPECT_EQ(answer.status, 415) << type;
    EXPECT_EQ(answer.json()["value"], type);
  }
  for (const char* type : {"application/json;charset=UTF-8", "Application/JSON; charset=\"utf-8\"",
                           "application/json\r\nContent-Encoding: identity"}) {
    EXPECT_EQ(post("/api/v1/jobs", "{}", type).status, 422) << type;
  }
  const auto packed = post("/api/v1/jobs", "{}", "application/json\r\nContent-Encoding: gzip");
  EXPECT_EQ(packed.status, 415);
  EXPECT_EQ(packed.json()["value"], "gzip");
  EXPECT_EQ(packed.json()["pointer"], "Content-Encoding");
}

TEST_F(Routes, ReportTheMethodThatIsNotServed) {
  start(1.0);
  EXPECT_EQ(test::request(port(), "PATCH", "/api/v1/jobs", "{}").json()["value"], "PATCH");
}

TEST_F(Routes, ServeTheDashboardAndNothingElse) {
  const fs::path folder = fs::path(::testing::TempDir()) / "armloom-web";
  fs::remove_all(folder);
  fs::create_directories(folder / "dist" / "assets");
  std::ofstream(folder / "secret.txt") << "secret";
  std::ofstream(folder / "dist" / ".hidden") << "secret";
  std::ofstream(folder / "dist" / "index.html") << "<html>";
  std::ofstream(folder / "dist" / "assets" / "app-1a2b.js") << "run()";
  fs::create_symlink(folder / "secret.txt", folder / "dist" / "link.txt");
  start(1.0, folder / "dist");

  const auto page = get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<html>");
  EXPECT_EQ(page.headers.at("content-type"), "text/html; charset=utf-8");
  EXPECT_EQ(page.headers.at("cache-control"), "no-cache");
  const auto script = get("/assets/app-1a2b.js");
  EXPECT_EQ(script.body, "run()");
  EXPECT_EQ(script.headers.at("content-type"), "text/javascript; charset=utf-8");
  EXPECT_NE(script.headers.at("cache-control").find("immutable"), std::string::npos);
  for (const char* path : {"/../secret.txt", "/%2e%2e/secret.txt", "/assets/../../secret.txt",
                           "/link.txt", "/.hidden", "/assets", "/assets/", "//etc/passwd"}) {
    const auto answer = get(path);
    EXPECT_EQ(answer.status, 404) << path;
    EXPECT_EQ(answer.body.find("secret\""), std::string::npos) << path;
  }
}

TEST_F(Routes, WorkWithoutTheDashboard) {
  start(1.0, "/nonexistent");
  EXPECT_EQ(get("/").status, 404);
  EXPECT_EQ(get("/healthz").status, 200);
}

}  // namespace
}  // namespace armloom
