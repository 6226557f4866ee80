#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "test/server/running_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

class ForeignPages : public test::RunningServer {
 protected:
  test::Answer ask(const std::string& method, const std::string& target,
                   const std::string& fields) {
    test::Wire wire(port());
    wire.send(method + " " + target + " HTTP/1.1\r\n" + fields + "\r\n");
    return test::read_answer(wire, method == "HEAD");
  }
};

TEST_F(ForeignPages, CannotReadByDnsRebinding) {
  options_.allowed_hosts = {"cell.example"};
  start(1.0);
  for (const char* target : {"/api/v1/jobs", "/api/v1/cell", "/api/v1/events", "/", "/docs",
                             "/openapi.json", "/metrics", "/api/v1/nothing", "/assets/x.js"}) {
    const auto answer = ask("GET", target, "Host: evil.example:8080\r\n");
    EXPECT_EQ(answer.status, 403) << target;
    EXPECT_EQ(answer.json()["type"], "urn:armloom:problem:foreign-host") << target;
    EXPECT_EQ(answer.json()["value"], "evil.example") << target;
  }
  for (const char* host : {"localhost:1", "127.0.0.1", "[::1]", "CELL.example:443"}) {
    EXPECT_EQ(ask("GET", "/api/v1/jobs", std::string("Host: ") + host + "\r\n").status, 200)
        << host;
  }
  // A liveness probe may use any host name.
  EXPECT_EQ(ask("GET", "/healthz", "Host: evil.example\r\n").status, 200);
}

// A request without Host comes from an old program, not from a browser, so DNS rebinding is
// impossible.
TEST_F(ForeignPages, DoNotIncludeHttp10Programs) {
  start(1.0);
  test::Wire wire(port());
  wire.send("GET /api/v1/jobs HTTP/1.0\r\n\r\n");
  EXPECT_EQ(test::read_answer(wire).status, 200);
}

TEST_F(ForeignPages, CannotFrameOrEmbedResponses) {
  const fs::path folder = fs::path(::testing::TempDir()) / "armloom-framed";
  fs::create_directories(folder);
  std::ofstream(folder / "index.html") << "<html>";
  start(1.0, folder);
  for (const char* target :
       {"/", "/docs", "/api/v1/queue", "/healthz", "/nothing", "/openapi.json"}) {
    const auto answer = get(target);
    const std::string& policy = answer.headers.at("content-security-policy");
    EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos) << target << ": " << policy;
    EXPECT_NE(policy.find("default-src 'none'"), std::string::npos) << target << ": " << policy;
    EXPECT_NE(policy.find("base-uri 'none'"), std::string::npos) << target << ": " << policy;
    EXPECT_EQ(answer.headers.at("x-frame-options"), "DENY") << target;
    EXPECT_EQ(answer.headers.at("x-content-type-options"), "nosniff") << target;
    EXPECT_EQ(answer.headers.at("cross-origin-resource-policy"), "same-origin") << target;
    EXPECT_EQ(answer.headers.at("cross-origin-opener-policy"), "same-origin") << target;
    EXPECT_EQ(answer.headers.at("referrer-policy"), "no-referrer") << target;
    EXPECT_EQ(policy.find("unsafe"), std::string::npos) << target << ": " << policy;
  }
  test::Wire events(port());
  events.send("GET /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const std::string head = events.take_until("\r\n\r\n");
  EXPECT_NE(head.find("frame-ancestors 'none'"), std::string::npos) << head;
}

}  // namespace
}  // namespace armloom
