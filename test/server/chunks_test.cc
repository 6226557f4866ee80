// Chunk extensions and trailers of a chunked body are bounded like headers (RFC 9112, 7.1.1).
#include <gtest/gtest.h>

#include <string>

#include "test/server/running_server.h"

namespace armloom {
namespace {

class ChunkedBody : public test::RunningServer {
 protected:
  void SetUp() override { start(1.0); }

  // The server's answer, and the bytes sent before it closed the connection.
  struct Said {
    std::string answer;
    std::size_t sent = 0;
  };
  Said said_to(const std::string& head, const std::string& piece, std::size_t pieces) {
    test::Wire wire(port());
    wire.send(
        "POST /api/v1/resume HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n" +
        head);
    Said said;
    for (std::size_t i = 0; i < pieces && wire.send(piece); ++i) said.sent += piece.size();
    said.answer = wire.take_all();
    return said;
  }
};

constexpr std::size_t kPiece = 64 * 1024;
constexpr std::size_t kPieces = 1024;

TEST_F(ChunkedBody, EndlessExtensionIsRefused) {
  const Said said = said_to("5;", std::string(kPiece, 'a'), kPieces);
  EXPECT_TRUE(said.answer.starts_with("HTTP/1.1 400 ")) << said.answer.substr(0, 300);
  EXPECT_NE(said.answer.find("chunk extensions"), std::string::npos) << said.answer;
  EXPECT_LT(said.sent, kPiece * kPieces);
}

TEST_F(ChunkedBody, ManyExtensionsAreRefusedBySize) {
  const std::string chunk = "1;" + std::string(1000, 'a') + "\r\nx\r\n";
  const Said said = said_to("", chunk, 64);
  EXPECT_TRUE(said.answer.starts_with("HTTP/1.1 400 ")) << said.answer.substr(0, 300);
  EXPECT_NE(said.answer.find("chunk extensions"), std::string::npos) << said.answer;
}

TEST_F(ChunkedBody, EndlessTrailersAreRefused) {
  const Said said = said_to("0\r\n", "X: " + std::string(kPiece, 'a') + "\r\n", kPieces);
  EXPECT_TRUE(said.answer.starts_with("HTTP/1.1 431 ")) << said.answer.substr(0, 300);
  EXPECT_LT(said.sent, kPiece * kPieces);
}

TEST_F(ChunkedBody, FewExtensionsAndTrailersAreIgnored) {
  test::Wire wire(port());
  wire.send(
      "PUT /api/v1/speed HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
      "Transfer-Encoding: chunked\r\n\r\n15;a=\"b\"\r\n{\"speed_override\": 1}\r\n"
      "0;last\r\nX-Sum: 7\r\nOrigin: http://evil.example\r\n\r\n");
  EXPECT_EQ(test::read_answer(wire).status, 200);
}

}  // namespace
}  // namespace armloom
