// Request smuggling (RFC 9112): whatever the framing of a request, the server never reads a second
// request out of the first one's remains.
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "test/server/running_server.h"

namespace armloom {
namespace {

using namespace std::string_literals;

// Returns the status codes of all answers to `bytes` and one more request.
class HostileBytes : public test::RunningServer {
 protected:
  void SetUp() override { start(1.0); }
  std::string statuses(const std::string& bytes) {
    test::Wire wire(port());
    wire.send(bytes + "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    const std::string all = wire.take_all();
    std::string found;
    for (std::size_t at = 0; (at = all.find("HTTP/1.", at)) != all.npos; ++at) {
      if (std::isdigit(static_cast<unsigned char>(all[at + 9])) != 0)
        found += all.substr(at + 9, 4);
    }
    return found;
  }
};

// Answered 415, because it has no Content-Type, if its bytes are accepted.
const std::string kPut = "PUT /api/v1/speed HTTP/1.1\r\nHost: localhost\r\n";
const std::string kChunked = kPut + "Transfer-Encoding: chunked\r\n\r\n";
const std::string kRest = "\r\n\r\n5\r\nhello\r\n0\r\n\r\n";

TEST_F(HostileBytes, AreRefusedAndEndTheConnection) {
  const std::string host = "\r\nHost: localhost\r\n\r\n";
  const std::string field = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n";
  std::vector<std::string> cases;
  for (const char* line :
       {"GET  /healthz HTTP/1.1", "GET /healthz  HTTP/1.1", "GET\t/healthz\tHTTP/1.1",
        "GET /healthz HTTP/1.1 ", " GET /healthz HTTP/1.1", "GET /healthz http/1.1",
        "GET /healthz HTTP/01.1", "GET /healthz HTTP/1.", "GET /healthz", "G@T /healthz HTTP/1.1",
        "GET /health\x7fz HTTP/1.1", "CONNECT localhost:80 HTTP/1.1"}) {
    cases.push_back(line + host);
  }
  cases.push_back("GET /heal\0thz HTTP/1.1"s + host);
  for (const std::string& line : {"X : a"s, "X\t: a"s, ": a"s, "X"s, "X(y): a"s, "X\0: a"s,
                                  "X: a\0b"s, "X: a\rb"s, "X: a\x7f"s, "\xc3\xa9: a"s}) {
    cases.push_back(field + line + "\r\n\r\n");
  }
  cases.push_back("GET /healthz HTTP/1.1\r\n Host: localhost\r\n\r\n");
  for (const char* length : {": 5, 5", ": 5, 6", ": -1", ": +5", ": 0x5", ": 18446744073709551621",
                             ":", ": 5 5", " : 5", ": 5\r\nContent-Length: 5"}) {
    cases.push_back(kPut + "Content-Length" + length + "\r\n\r\nhello");
  }
  for (const char* coding :
       {": chunked,", ": , chunked", ": chunked, chunked", ": chunked;q=1", ": \"chunked\"",
        ": \x0b"
        "chunked",
        ": chunked\xa0", " : chunked", ": chunked\r\nContent-Length: 5"}) {
    cases.push_back(kPut + "Transfer-Encoding" + coding + kRest);
  }
  cases.push_back("PUT /api/v1/speed HTTP/1.0\r\nTransfer-Encoding: chunked" + kRest);
  for (const char* body :
       {"0x5\r\nhello\r\n", "-5\r\nhello\r\n", "+5\r\nhello\r\n", " 5\r\nhello\r\n",
        "5 \r\nhello\r\n", "\r\nhello\r\n", "10000000000000005\r\nhello\r\n", "5\nhello\r\n",
        "5\r\nhello\n", "5\r\nhello", "5\r\nhelloX\r\n", "5;a\nb\r\nhello\r\n",
        "5;a\rb\r\nhello\r\n"}) {
    cases.push_back(kChunked + body + "0\r\n\r\n");
  }
  for (const char* last : {"0\n\n", "0\r\nX : y\r\n\r\n", "0\r\nContent-Length: 100\r\n\r\n"}) {
    cases.push_back(kChunked + "5\r\nhello\r\n" + last);
  }
  cases.push_back(kPut + "Content-Length:\r\n 5\r\n\r\nhello");  // obs-fold
  cases.push_back(kPut + "X: a\r\n\tGET / HTTP/1.1\r\nContent-Length: 0\r\n\r\n");
  for (const std::string& bytes : cases) EXPECT_EQ(statuses(bytes), "400 ") << bytes;
  EXPECT_EQ(statuses(kChunked + "FFFFFFFFFFFFFFFF\r\nhello\r\n"), "413 ");
}

// Unusual requests that RFC 9112 requires or allows a recipient to accept.
TEST_F(HostileBytes, AreAcceptedIfOnlyUnusual) {
  const std::pair<std::string, std::string> cases[] = {
      {kPut + "Content-Length: 05\r\n\r\nhello", "415 200 "},
      {kPut + "Content-Length:5\t \r\n\r\nhello", "415 200 "},
      {kPut + "Transfer-Encoding:\tchunked\t" + kRest, "415 200 "},
      {kChunked + "0005\r\nhello\r\n0000\r\n\r\n", "415 200 "},
      {kChunked + "5;a=\"b\";c\r\nhello\r\n0;d\r\nX-Sum: 7\r\n\r\n", "415 200 "},
      {"GET /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: 5\r\n\r\nhello", "200 200 "},
      // methods are case-sensitive
      {"get /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n", "405 200 "},
      {"GET /healthz HTTP/1.1\r\nhOST:localhost\r\nX-\xe2\x82\xac!: a\r\n\r\n", "400 "},
      {"GET /healthz HTTP/1.1\r\nhOST:localhost\r\nX!#$%&'*+-.^_`|~: \xe2\x82\xac\r\n\r\n",
       "200 200 "},
  };
  for (const auto& [bytes, told] : cases) EXPECT_EQ(statuses(bytes), told) << bytes;
}

}  // namespace
}  // namespace armloom
