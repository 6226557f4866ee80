#include "server/http/framing.h"

#include <gtest/gtest.h>

#include <string>

#include "server/http/message.h"
#include "test/server/running_server.h"

namespace armloom {
namespace {

// Returns all answers to the bytes until the server closes the connection.
class Framing : public test::RunningServer {
 protected:
  std::string answers_to(const std::string& bytes) {
    test::Wire wire(port());
    wire.send(bytes);
    return wire.take_all();
  }
  static int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
  }
};

// A second request smuggled behind a request with ambiguous framing.
const std::string kHidden = "5\r\nhello\r\n0\r\n\r\nGET /healthz HTTP/1.1\r\nHost: x\r\n\r\n";

TEST_F(Framing, RefusesAmbiguousRequestsThatBeastAccepts) {
  start(1.0);
  const std::string post = "POST /api/v1/stop HTTP/1.1\r\n";
  const std::string cases[] = {
      post + "Host: x\r\nTransfer-Encoding: xchunked\r\n\r\n" + kHidden,
      post + "Host: x\r\nTransfer-Encoding: identity\r\n\r\n" + kHidden,
      post + "Host: x\r\nTransfer-Encoding: \r\n\r\n" + kHidden,
      post + "Host: x\r\nTransfer-Encoding: gzip, chunked\r\n\r\n" + kHidden,
      post + "Host: x\r\nTransfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n\r\n" +
          kHidden,
      post + "Host: x\r\nTransfer-Encoding: chunked\r\nContent-Length: 5\r\n\r\n" + kHidden,
      post + "Host: x\r\nContent-Length: 5\r\nContent-Length: 6\r\n\r\nhello" + kHidden,
      post + "Host: x\r\nContent-Length: +5\r\n\r\nhello" + kHidden,
      post + "Content-Length: 0\r\n\r\n",
      post + "Host: x\r\nHost: x\r\nContent-Length: 0\r\n\r\n",
      post + "Host: \r\nContent-Length: 0\r\n\r\n",
      post + "Host: a b\r\nContent-Length: 0\r\n\r\n",
      post + "Host: user@x\r\nContent-Length: 0\r\n\r\n",
      post + "Host: x:port\r\nContent-Length: 0\r\n\r\n",
      "\x16\x03\x01 this is not HTTP\r\n\r\n",
  };
  for (const std::string& bytes : cases) {
    const std::string answer = answers_to(bytes);
    EXPECT_EQ(count(answer, "HTTP/1.1 "), 1) << bytes << "\n" << answer;
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 400 ")) << bytes << "\n" << answer;
  }
  EXPECT_NE(answers_to(post + "Host: user@x\r\n\r\n").find(R"("value":"user@x")"),
            std::string::npos);
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], false);
}

TEST_F(Framing, ServesPipelinedRequests) {
  start(1.0);
  const std::string answer = answers_to(
      "GET /healthz HTTP/1.1\r\nHost: [::1]:8080\r\n\r\n"
      "PUT /api/v1/speed HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: "
      "Chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n"
      "HEAD /healthz HTTP/1.1\r\nHost: x\r\n\r\n"
      "GET /healthz HTTP/1.0\r\n\r\n");
  EXPECT_EQ(count(answer, "HTTP/1.1 200 OK"), 2) << answer;
  EXPECT_EQ(count(answer, "HTTP/1.1 415 "), 1) << answer;  // no Content-Type
  EXPECT_EQ(count(answer, "HTTP/1.0 200 OK"), 1) << answer;
  EXPECT_EQ(count(answer, "{\"status\":\"ok\"}"), 2) << answer;  // the answer to HEAD has no body
}

TEST_F(Framing, RefusesABodyThatIsTooLargeBeforeItIsSent) {
  start(1.0);
  const std::string answer = answers_to(
      "POST /api/v1/jobs HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
      "Content-Length: 8388609\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 413 ")) << answer;
  EXPECT_NE(answer.find("body-too-large"), std::string::npos);
}

TEST_F(Framing, RefusesAHeaderThatIsTooLarge) {
  start(1.0);
  const std::string answer =
      answers_to("GET / HTTP/1.1\r\nHost: x\r\nX: " + std::string(20'000, 'a') + "\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 431 ")) << answer;
}

// RFC 9112, section 3.
TEST_F(Framing, RefusesARequestLineThatIsTooLong) {
  start(1.0);
  const std::string answer =
      answers_to("GET /" + std::string(70'000, 'a') + " HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 414 ")) << answer;
}

TEST_F(Framing, AnswersExpect100Continue) {
  start(1.0);
  test::Wire wire(port());
  wire.send(
      "PUT /api/v1/speed HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
      "Expect: 100-continue\r\nContent-Length: 21\r\n\r\n");
  EXPECT_EQ(wire.take_until("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  wire.send(R"({"speed_override": 1})");
  EXPECT_EQ(test::read_answer(wire).status, 200);
}

TEST_F(Framing, RefusesOtherOrigins) {
  start(1.0);
  const std::string post =
      "POST /api/v1/stop HTTP/1.1\r\nHost: localhost:80\r\nConnection: close\r\nContent-Length: "
      "0\r\n";
  EXPECT_TRUE(
      answers_to(post + "Origin: http://evil.example\r\n\r\n").starts_with("HTTP/1.1 403 "));
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], false);
  EXPECT_TRUE(
      answers_to(post + "Origin: http://localhost:80\r\n\r\n").starts_with("HTTP/1.1 202 "));
}

TEST_F(Framing, RefusesForeignHostsAgainstDnsRebinding) {
  options_.allowed_hosts = {"cell.example"};
  start(1.0);
  const auto resume = [&](const std::string& method, const std::string& host) {
    return answers_to(method + " HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
                      "\r\nConnection: close\r\nContent-Length: 0\r\n\r\n");
  };
  const std::string command = "POST /api/v1/resume";
  const std::string refused = resume(command, "evil.example:80");
  EXPECT_TRUE(refused.starts_with("HTTP/1.1 403 ")) << refused;
  EXPECT_NE(refused.find(R"("value":"evil.example")"), std::string::npos) << refused;
  EXPECT_TRUE(resume(command, "robots").starts_with("HTTP/1.1 403 "));
  for (const char* host : {"localhost:80", "127.0.0.1", "[::1]:8080", "Cell.example:443"}) {
    EXPECT_TRUE(resume(command, host).starts_with("HTTP/1.1 202 ")) << host;
  }
}

TEST(HostRule, AllowsPlainNamesIfTheServerListensOnAllAddresses) {
  const HostRule everywhere{.names = {}, .any_plain = true};
  EXPECT_TRUE(is_allowed_host("robots", everywhere));
  EXPECT_FALSE(is_allowed_host("evil.example", everywhere));
  EXPECT_FALSE(is_allowed_host("127.0.0.1.evil.example", everywhere));
}

TEST(Authority, HasANameAndAnOptionalPort) {
  for (const char* good : {"x", "localhost:8080", "127.0.0.1", "[::1]:80", "a-b.c_d", "x:"}) {
    EXPECT_TRUE(valid_authority(good)) << good;
  }
  for (const char* bad :
       {"", ":80", "a b", "a,b", "a/b", "u@h", "[::1", "x:123456", "x:8a", "[]"}) {
    EXPECT_FALSE(valid_authority(bad)) << bad;
  }
}

TEST(TargetOfRequest, IsDecodedOnceAndRejectsEncodedSlashes) {
  const auto target = parse_target("/api/v1/jobs/a%2eb?state=running&arm=le%66t&x=1+2");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/api/v1/jobs/a.b");
  EXPECT_EQ(target->parameter("arm"), "left");
  EXPECT_EQ(target->parameter("x"), "1 2");
  EXPECT_FALSE(target->parameter("y"));
  for (const char* bad : {"", "*", "http://x/", "/%2f", "/%5c", "/%00", "/%4", "/%zz"}) {
    EXPECT_FALSE(parse_target(bad)) << bad;
  }
}

TEST(TargetOfRequest, ReportsTheFirstFaultOfTheQuery) {
  const auto broken = parse_target("/?a=%1&b=2&b=3");
  ASSERT_TRUE(broken && broken->query_fault);
  EXPECT_EQ(broken->query_fault->slug, "bad-target");
  EXPECT_FALSE(broken->parameter("a"));
  const auto twice = parse_target("/?b=2&b=3&a=%1");
  ASSERT_TRUE(twice && twice->query_fault);
  EXPECT_EQ(twice->query_fault->pointer, "?b");
  EXPECT_EQ(twice->parameter("b"), "2");
  EXPECT_EQ(query_problem(*twice, {"a", "b"})->pointer, "?b");
}

}  // namespace
}  // namespace armloom
