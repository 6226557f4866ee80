#include <gtest/gtest.h>

#include <regex>

#include "server/codec/rfc3339.h"
#include "server/codec/stream_id.h"
#include "server/codec/wall_clock.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

const WallClock::Wall kStart{std::chrono::sys_days{std::chrono::year{2026} / 11 / 21} + 9h + 33min};

TEST(WallClock, WritesCellTimesInUtcWithMilliseconds) {
  const WallClock clock(kStart, 1.0);
  EXPECT_EQ(clock.at(at(125ms)), "2026-11-21T09:33:00.125Z");
  EXPECT_EQ(clock.at(at(14h + 27min + 1500us)), "2026-11-22T00:00:00.001Z");
}

TEST(Rfc3339, ReadsItsOwnFormatAndOtherOffsets) {
  const std::int64_t instant = since_1970_ms(kStart + 125ms);
  for (const char* text : {"2026-11-21T09:33:00.125Z", "2026-11-21t09:33:00.1259z",
                           "2026-11-21 11:33:00.125+02:00", "2026-11-20T23:03:00.125-10:30"}) {
    EXPECT_EQ(read_rfc3339(text), instant) << text;
  }
  EXPECT_EQ(read_rfc3339("1969-12-31T23:59:59.5Z"), -500);
  EXPECT_EQ(rfc3339(-500), "1969-12-31T23:59:59.500Z");
  for (const char* text :
       {"", "2026", "2026-11-21", "2026-11-21T09:33:00", "2026-11-31T09:33:00Z",
        "2026-11-21T24:00:00Z", "2026-11-21T09:60:00Z", "2026-11-21T09:33:00.Z",
        "2026-11-21T09:33:00ZZ", "2026-11-21T09:33:00+02", "2026-11-21T09:33:00+24:00",
        "+026-11-21T09:33:00Z", "2026-11-21T09:33:00.125 Z", "1795253580"}) {
    EXPECT_FALSE(read_rfc3339(text)) << text;
  }
}

TEST(WallClock, FollowsTheSpeedOfTheCell) {
  const WallClock clock(kStart, 10.0);
  EXPECT_EQ(clock.wall_at(at(30s)), kStart + 3s);
}

TEST(WallClock, KeepsEarlierTimesWhenTheSpeedChanges) {
  WallClock clock(kStart, 1.0);
  clock.anchor(at(10s), kStart + 10s, 5.0);
  EXPECT_EQ(clock.wall_at(at(4s)), kStart + 4s);
  EXPECT_EQ(clock.wall_at(at(20s)), kStart + 12s);
}

TEST(WallClock, FollowsOnlyLargeSlips) {
  WallClock clock(kStart, 2.0);
  clock.observe(at(2s), kStart + 1s + WallClock::kSlip);
  EXPECT_EQ(clock.wall_at(at(2s)), kStart + 1s) << "within what a machine may be late";
  clock.observe(at(4s), kStart + 3s);
  EXPECT_EQ(clock.wall_at(at(4s)), kStart + 3s);
  EXPECT_EQ(clock.wall_at(at(6s)), kStart + 4s) << "at the same speed from there";
  EXPECT_EQ(clock.wall_at(at(2s)), kStart + 1s);
}

// Instants before all anchors are converted by the oldest remaining anchor.
TEST(WallClock, ForgetsTheOldestAnchors) {
  WallClock clock(kStart, 1.0);
  for (std::size_t i = 1; i <= WallClock::kAnchorsMax; ++i) {
    const auto second = std::chrono::seconds(i);
    clock.anchor(at(second), kStart + 1h + second, 1.0);
  }
  EXPECT_EQ(clock.wall_at(at(0s)), kStart + 1h);
}

TEST(WallClock, ConvertsTimesOfEarlierSessionsToNegativeTimes) {
  const WallClock clock(kStart, 2.0);
  EXPECT_EQ(clock.time_before(kStart - 5s), at(-10s));
  EXPECT_EQ(clock.wall_at(clock.time_before(kStart - 5s)), kStart - 5s);
  EXPECT_EQ(clock.time_before(kStart + 5s), at(0s)) << "the wall's clock was set back";
}

TEST(Streams, DependOnlyOnTheSeedOfASimulation) {
  EXPECT_EQ(stream_of_seed(7), stream_of_seed(7));
  EXPECT_NE(stream_of_seed(7), stream_of_seed(8));
  EXPECT_NE(random_stream(), random_stream());
}

// RFC 9562: version and variant.
TEST(Streams, AreUuids) {
  const std::regex of_seed("[0-9a-f]{8}-[0-9a-f]{4}-8[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  const std::regex random("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  for (const std::uint64_t seed : {0ULL, 1ULL, ~0ULL}) {
    EXPECT_TRUE(std::regex_match(stream_of_seed(seed), of_seed)) << stream_of_seed(seed);
  }
  EXPECT_TRUE(std::regex_match(random_stream(), random));
}

}  // namespace
}  // namespace armloom
