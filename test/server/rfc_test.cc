#include <gtest/gtest.h>

#include "test/server/running_server.h"

namespace armloom {
namespace {

class Rfc : public test::RunningServer {
 protected:
  void SetUp() override { start(1.0); }
  std::string answers_to(const std::string& bytes) {
    test::Wire wire(port());
    wire.send(bytes);
    return wire.take_all();
  }
  test::Answer answer_to(const std::string& bytes) {
    test::Wire wire(port());
    wire.send(bytes);
    return test::read_answer(wire);
  }
};

// RFC 9110, 10.1.1.
TEST_F(Rfc, Http10NeverGets100Continue) {
  const std::string answer = answers_to(
      "PUT /api/v1/speed HTTP/1.0\r\nContent-Type: application/json\r\nExpect: 100-continue\r\n"
      "Content-Length: 21\r\n\r\n{\"speed_override\": 1}");
  EXPECT_TRUE(answer.starts_with("HTTP/1.0 200 ")) << answer;
}

// RFC 9110, 10.1.1.
TEST_F(Rfc, RefusedRequestsGetNo100Continue) {
  const std::string rest = "Expect: 100-continue\r\nContent-Length: 2\r\n\r\n";
  const std::string post = "POST /api/v1/resume HTTP/1.1\r\nHost: localhost\r\n";
  EXPECT_TRUE(
      answers_to(post + "Origin: http://evil.example\r\n" + rest).starts_with("HTTP/1.1 403 "));
  EXPECT_TRUE(answers_to("POST /api/v1/resume HTTP/1.1\r\nHost: evil.example\r\n" + rest)
                  .starts_with("HTTP/1.1 403 "));
  EXPECT_TRUE(answers_to("POST /api/v1/nothing HTTP/1.1\r\nHost: localhost\r\n" + rest)
                  .starts_with("HTTP/1.1 404 "));
  EXPECT_TRUE(answers_to("PATCH /api/v1/jobs HTTP/1.1\r\nHost: localhost\r\n" + rest)
                  .starts_with("HTTP/1.1 405 "));
}

// RFC 9112, 3.2.2: the authority of an absolute-form target replaces Host.
TEST_F(Rfc, AbsoluteTargetsAreServed) {
  EXPECT_EQ(answer_to("GET http://localhost:80/api/v1/queue?  HTTP/1.1\r\nHost: x\r\n\r\n").status,
            400);
  EXPECT_EQ(answer_to("GET http://localhost:80/api/v1/queue HTTP/1.1\r\nHost: x\r\n\r\n").status,
            200);
  EXPECT_EQ(answer_to("GET HTTP://127.0.0.1/healthz HTTP/1.1\r\nHost: x\r\n\r\n").status, 200);
  EXPECT_EQ(
      answer_to("GET http://evil.example/api/v1/queue HTTP/1.1\r\nHost: localhost\r\n\r\n").status,
      403);
  for (const char* bad : {"http:///healthz", "http://a b/healthz", "http://u@localhost/healthz",
                          "ftp://localhost/healthz", "healthz"}) {
    EXPECT_EQ(answer_to(std::string("GET ") + bad + " HTTP/1.1\r\nHost: localhost\r\n\r\n").status,
              400)
        << bad;
  }
}

// RFC 9112, 2.2; many empty lines are refused.
TEST_F(Rfc, EmptyLineBeforeARequestIsIgnored) {
  const std::string get = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  test::Wire wire(port());
  wire.send("\r\n" + get);
  EXPECT_EQ(test::read_answer(wire).status, 200);
  wire.send("\r\n");
  wire.send("\r\n" + get);
  EXPECT_EQ(test::read_answer(wire).status, 200);
  std::string many;
  for (int i = 0; i < 100; ++i) many += "\r\n";
  EXPECT_EQ(answer_to(many + get).status, 400);
}

// RFC 9110, 9.3.7.
TEST_F(Rfc, OptionsListsTheMethods) {
  const auto all = answer_to("OPTIONS * HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(all.status, 204);
  EXPECT_EQ(all.headers.at("allow"), "DELETE, GET, HEAD, OPTIONS, PATCH, POST, PUT");
  const auto jobs = answer_to("OPTIONS /api/v1/jobs HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(jobs.status, 204);
  EXPECT_EQ(jobs.headers.at("allow"), "GET, HEAD, OPTIONS, POST");
  EXPECT_EQ(jobs.headers.count("content-length"), 0U);
  EXPECT_EQ(answer_to("OPTIONS /api/v1/nothing HTTP/1.1\r\nHost: localhost\r\n\r\n").status, 404);
  EXPECT_EQ(answer_to("GET * HTTP/1.1\r\nHost: localhost\r\n\r\n").status, 400);
}

// RFC 9110, 2.5.
TEST_F(Rfc, HigherMinorVersionsAreServedOtherMajorsAreNot) {
  EXPECT_TRUE(answers_to("GET /healthz HTTP/1.2\r\nHost: localhost\r\nConnection: close\r\n\r\n")
                  .starts_with("HTTP/1.1 200 "));
  EXPECT_TRUE(
      answers_to("GET /healthz HTTP/2.0\r\nHost: localhost\r\n\r\n").starts_with("HTTP/1.1 505 "));
  EXPECT_TRUE(answers_to("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n").starts_with("HTTP/1.1 505 "));
  EXPECT_TRUE(
      answers_to("GET /healthz HTTP/1.x\r\nHost: localhost\r\n\r\n").starts_with("HTTP/1.1 400 "));
}

// RFC 9112, 3.2.
TEST_F(Rfc, FragmentsAreRefused) {
  for (const char* target : {"/healthz#", "/healthz#x", "/api/v1/jobs?limit=1#x",
                             "http://localhost/healthz#x", "http://localhost#x"}) {
    EXPECT_EQ(
        answer_to(std::string("GET ") + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n").status,
        400)
        << target;
  }
}

// RFC 9110, 9.3.2: HEAD returns the fields of GET.
TEST_F(Rfc, HeadOfEventsHasNoLength) {
  const std::string rest = " /api/v1/events HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string head = answers_to("HEAD" + rest);
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200 ")) << head;
  EXPECT_TRUE(head.ends_with("\r\n\r\n")) << head;
  EXPECT_EQ(head.find("Content-Length"), head.npos) << head;
  EXPECT_NE(head.find("Content-Type: text/event-stream\r\n"), head.npos) << head;
}

// RFC 9110, 8.8.3 and 13.1.1.
TEST_F(Rfc, MalformedEntityTagsAreRefused) {
  const auto patch = [&](const std::string& if_match) {
    return answer_to(
               "PATCH /api/v1/jobs/x HTTP/1.1\r\nHost: localhost\r\nContent-Type: "
               "application/json\r\n"
               "Content-Length: 2\r\nIf-Match: " +
               if_match + "\r\n\r\n{}")
        .status;
  };
  for (const char* bad : {"foo", "\"foo", "W/foo", "\"a\" \"b\"", "*, \"a\"", "", ",", "w/\"a\""}) {
    EXPECT_EQ(patch(bad), 400) << bad;
  }
  for (const char* good : {"*", "\"\"", "\"a,b\"", "W/\"a\" , \"b\"", ", \"a\","}) {
    EXPECT_EQ(patch(good), 404) << good;
  }
}

// RFC 6455, 7.4.
TEST_F(Rfc, ReservedCloseCodesAreAProtocolError) {
  const auto answer_to_close = [&](int code) {
    test::Wire wire(port());
    test::begin_websocket(wire);
    wire.send(std::string("\x88\x82\0\0\0\0", 6) + static_cast<char>(code >> 8) +
              static_cast<char>(code & 0xff));
    const std::string all = wire.take_all();  // event frames, and the close frame last
    const std::string last = all.substr(all.size() - 4);
    EXPECT_EQ(last.substr(0, 2), std::string("\x88\x02")) << code;
    return static_cast<unsigned char>(last[2]) * 256 + static_cast<unsigned char>(last[3]);
  };
  for (const int bad : {0, 999, 1004, 1005, 1006, 1014, 1015, 1016, 2999, 5000, 65535}) {
    EXPECT_EQ(answer_to_close(bad), 1002) << bad;
  }
  for (const int good : {1000, 1001, 3000, 4999}) EXPECT_EQ(answer_to_close(good), good);
}

// RFC 6455, 4.2: the key is base64 of 16 bytes, the version is 13.
TEST_F(Rfc, InvalidHandshakesAreRefused) {
  const auto shake = [&](const std::string& key, const std::string& version) {
    return answer_to(
        "GET /api/v1/ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
        "Connection: Upgrade\r\n" +
        key + version + "\r\n");
  };
  const std::string key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  const std::string version = "Sec-WebSocket-Version: 13\r\n";
  for (const char* bad : {"x", "dGhlIHNhbXBsZSBub25jZQ=", "dGhlIHNhbXBsZSBub25jZQ", "",
                          "dGhlIHNhbXBsZSBub25jZ!==", "dGhlIHNhbXBsZSBub25jZWFh"}) {
    const auto answer = shake(std::string("Sec-WebSocket-Key: ") + bad + "\r\n", version);
    EXPECT_EQ(answer.status, 400) << bad;
  }
  EXPECT_EQ(shake("", version).status, 400);
  EXPECT_EQ(shake(key + key, version).status, 400);
  const auto other = shake(key, "Sec-WebSocket-Version: 8\r\n");
  EXPECT_EQ(other.status, 426);
  EXPECT_EQ(other.headers.at("sec-websocket-version"), "13");
  EXPECT_EQ(other.headers.at("upgrade"), "websocket");
  EXPECT_EQ(shake(key, "").status, 426);
}

}  // namespace
}  // namespace armloom
