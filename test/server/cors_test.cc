#include <gtest/gtest.h>

#include "test/server/running_server.h"

namespace armloom {
namespace {

constexpr const char* kStation = "https://station.example:8443";

class Cors : public test::RunningServer {
 protected:
  void SetUp() override {
    options_.allowed_origins = {kStation};
    start(1);
  }
  test::Answer ask(const std::string& method, const std::string& path, const std::string& origin,
                   const std::string& more = "") {
    test::Wire wire(port());
    wire.send(method + " " + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nOrigin: " + origin + "\r\n" +
              more + "\r\n");
    return test::read_answer(wire);
  }
};

TEST_F(Cors, AllowedOriginMaySendAllRequests) {
  const auto asked = ask("OPTIONS", "/api/v1/jobs", kStation,
                         "Access-Control-Request-Method: POST\r\n"
                         "Access-Control-Request-Headers: authorization,content-type\r\n");
  EXPECT_EQ(asked.status, 204);
  EXPECT_EQ(asked.headers.at("access-control-allow-origin"), kStation);
  EXPECT_NE(asked.headers.at("access-control-allow-methods").find("POST"), std::string::npos);
  EXPECT_NE(asked.headers.at("access-control-allow-headers").find("Authorization"),
            std::string::npos);
  const auto stopped = ask("POST", "/api/v1/stop", kStation, "Content-Length: 0\r\n");
  EXPECT_EQ(stopped.status, 202);
  EXPECT_EQ(stopped.headers.at("access-control-allow-origin"), kStation);
  EXPECT_EQ(stopped.headers.at("vary"), "Accept, Accept-Encoding, Origin");
  const auto refused = ask("GET", "/api/v1/arms/nobody", kStation);
  EXPECT_EQ(refused.status, 404);
  EXPECT_EQ(refused.headers.at("access-control-allow-origin"), kStation) << "problems, too";
}

TEST_F(Cors, AllowedOriginMaySubscribeToEvents) {
  test::Wire wire(port());
  wire.send(std::string("GET /api/v1/events HTTP/1.1\r\nHost: 127.0.0.1\r\nOrigin: ") + kStation +
            "\r\n\r\n");
  EXPECT_NE(
      wire.take_until("\r\n\r\n").find(std::string("Access-Control-Allow-Origin: ") + kStation),
      std::string::npos);
}

TEST_F(Cors, OtherOriginsAreRefused) {
  for (const char* origin : {"https://station.example", "http://station.example:8443",
                             "https://station.example:8443.evil.example", "null"}) {
    EXPECT_EQ(ask("OPTIONS", "/api/v1/jobs", origin).status, 403) << origin;
    EXPECT_EQ(ask("POST", "/api/v1/stop", origin, "Content-Length: 0\r\n").status, 403) << origin;
    const auto read = ask("GET", "/api/v1/arms", origin);
    EXPECT_EQ(read.headers.count("access-control-allow-origin"), 0U) << origin;
  }
}

TEST_F(Cors, HeadersAreSentOnlyForRequestsWithAnOrigin) {
  EXPECT_EQ(get("/api/v1/arms").headers.count("access-control-allow-origin"), 0U);
  test::Wire wire(port());
  wire.send(std::string("GET /api/v1/arms HTTP/1.1\r\nHost: elsewhere.example\r\nOrigin: ") +
            kStation + "\r\n\r\n");
  EXPECT_EQ(test::read_answer(wire).status, 403) << "a name that is not the server's";
}

}  // namespace
}  // namespace armloom
