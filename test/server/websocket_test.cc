// RFC 6455, frame by frame, like the published suites: fragmentation, UTF-8, control frames, close,
// limits.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "test/server/running_server.h"

namespace armloom {
namespace {

using namespace std::string_literals;

constexpr char kMask[] = {1, 2, 3, 4};

std::string masked(std::string payload) {
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] ^= kMask[i % 4];
  return std::string(kMask, 4) + payload;
}

// `first`: FIN, reserved bits and opcode. `length`: encoding of the payload's length, if not the
// shortest.
std::string frame(int first, const std::string& payload = "", std::string length = "") {
  const std::size_t size = payload.size();
  if (length.empty() && size < 126) length = std::string(1, static_cast<char>(size));
  if (length.empty()) {
    length = "\x7e"s + static_cast<char>(size >> 8U) + static_cast<char>(size & 0xffU);
  }
  length[0] = static_cast<char>(length[0] | 0x80);
  return static_cast<char>(first) + length + masked(payload);
}

constexpr int kText = 0x81, kBinary = 0x82, kClose = 0x88, kPing = 0x89, kPong = 0x8a;
constexpr int kTextBegins = 0x01, kGoesOn = 0x00, kEnds = 0x80;

const std::string kBye = frame(kClose, "\x03\xe8");

class WebSocketFrames : public test::RunningServer {
 protected:
  void SetUp() override { start(1.0); }

  // Returns the response without events: pongs as "pong:payload ", and the close code.
  std::string answer_to(const std::string& frames) {
    test::Wire wire(port());
    test::begin_websocket(wire);
    wire.send(frames);
    std::string told;
    for (;;) {
      const auto [kind, payload] = test::take_frame(wire);
      if (kind == kPong) told += "pong:" + payload + " ";
      if (kind == kClose) return told + std::to_string(test::number_of(payload.substr(0, 2)));
    }
  }
};

TEST_F(WebSocketFrames, InvalidFramesCloseWithTheRightCode) {
  const std::string a126(126, 'a');
  const std::pair<const char*, std::vector<std::string>> broken[] = {
      {"1002",
       {"\x81\x01x",  // not masked
        frame(0xc1, "x"),
        frame(0xa1, "x"),
        frame(0x91, "x"),  // reserved bits
        frame(0x83, "x"),
        frame(0x87, "x"),
        frame(0x8b, "x"),
        frame(0x8f, "x"),
        frame(kPing, a126),
        frame(kClose, "\x03\xe8" + a126),
        frame(0x09, "x"),
        frame(0x08),
        frame(kEnds, "x"),
        frame(kGoesOn, "x"),
        frame(kTextBegins, "a") + frame(kText, "b"),
        frame(kTextBegins, "a") + frame(kTextBegins, "b"),
        frame(kTextBegins, "a") + frame(kEnds, "b") + frame(kEnds, "c"),
        frame(kClose, "\x03"),
        frame(kClose, "\x03\xe8\xff"),
        frame(kText, "hi", "\x7e\0\2"s),
        frame(kText, "hi", "\x7f\0\0\0\0\0\0\0\2"s)}},
      {"1007",
       {frame(kText, "\xff"), frame(kText, "\xc0\xaf"), frame(kText, "\xed\xa0\x80"),
        frame(kText, "\xf4\x90\x80\x80"), frame(kText, "\xe2\x82"),
        frame(kTextBegins, "\xe2") + frame(kEnds, "\x82"),
        frame(kTextBegins, "good") + frame(kGoesOn, "\xfe") + frame(kEnds)}},
      {"1009",
       {frame(kText, std::string(4097, 'a')),
        frame(kTextBegins, std::string(3000, 'a')) + frame(kEnds, std::string(3000, 'a')),
        frame(kBinary, "", "\x7f\x7f\xff\xff\xff\xff\xff\xff\xff"),
        frame(kBinary, "", "\x7f\xff\xff\xff\xff\xff\xff\xff\xff")}}};
  for (const auto& [code, frames] : broken) {
    for (const std::string& one : frames) {
      EXPECT_EQ(answer_to(one), code) << ::testing::PrintToString(one.substr(0, 20));
    }
  }
}

TEST_F(WebSocketFrames, ValidFramesAreIgnoredAndPingsAreAnswered) {
  const std::string a125(125, 'a');
  std::string pings, pongs;
  for (const char i : "0123456789"s) {
    pings += frame(kPing, std::string(1, i));
    pongs += "pong:"s + i + " ";
  }
  const std::pair<std::string, std::string> sound[] = {
      {"", ""},
      {frame(kText, "hi"), ""},
      {frame(kText), ""},
      {frame(kBinary, "\xff\0"s), ""},
      {frame(kText, std::string(4096, 'a')), ""},
      {frame(kPong, "not asked for"), ""},
      {frame(kPing), "pong: "},
      {frame(kPing, a125), "pong:" + a125 + " "},
      {pings, pongs},
      {frame(kTextBegins, "a") + frame(kGoesOn) + frame(kEnds, "b"), ""},
      {frame(kTextBegins, "a") + frame(kPing, "p") + frame(kEnds, "b"), "pong:p "},
      {frame(kTextBegins, "\xe2") + frame(kGoesOn, "\x82") + frame(kEnds, "\xac"), ""}};
  for (const auto& [frames, told] : sound) EXPECT_EQ(answer_to(frames + kBye), told + "1000");
  EXPECT_EQ(answer_to(kBye + frame(kPing, "late")), "1000");
  EXPECT_EQ(answer_to(frame(kClose, "\x03\xe8 bye")), "1000");
  EXPECT_EQ(answer_to(frame(kClose)), "1000");
}

}  // namespace
}  // namespace armloom
