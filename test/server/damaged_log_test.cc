#include <gtest/gtest.h>

#include "server/replay/replay.h"
#include "test/scenarios/seeds.h"
#include "test/server/live_run.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using test::LiveRun;
using test::Told;
using test::two_pandas;

class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed) {}

  void to_line(std::string& line) {
    const std::size_t at = random_() % line.size();
    switch (random_() % 5) {
      case 0:
        line[at] = static_cast<char>(random_() % 256);
        break;
      case 1:
        line.erase(at, 1 + random_() % 20);
        break;
      case 2:
        line.insert(at, kScraps[random_() % std::size(kScraps)]);
        break;
      case 3:
        change_value(line);
        break;
      default:
        line.resize(at);
    }
  }
  std::size_t below(std::size_t size) { return random_() % size; }

 private:
  // Replaces a value by one of another type or size; the line remains JSON.
  void change_value(std::string& line) {
    std::size_t colon = line.find(':', random_() % line.size());
    if (colon == line.npos) colon = line.find(':');
    if (colon == line.npos) return;
    const std::size_t end = line.find_first_of(",}", colon);
    line.replace(colon + 1, end - colon - 1, kValues[random_() % std::size(kValues)]);
  }

  static constexpr const char* kScraps[] = {"9",  "-", "\"",   "}",      "[[",
                                            "e9", ",", "null", "\\u0000"};
  static constexpr const char* kValues[] = {
      "null", "-1",    "18446744073709551615", "1e300", "\"\"", "[]", "true", "{\"a\":1}",
      "0",    "[null]"};
  std::mt19937_64 random_;
};

// Returns true if every line was accepted; stops at the first refused line.
bool is_taken_whole(const std::vector<std::string>& log) {
  Told told;
  auto replay = Replay::begin(two_pandas(), log.front(), told);
  if (!replay) return false;
  for (std::size_t i = 1; i < log.size(); ++i) {
    if (!(*replay)->take(log[i])) return false;
  }
  return true;
}

TEST(DamagedLog, IsRefusedWithoutExceptions) {
  int refused = 0;
  const int runs = static_cast<int>(seed_count(8));
  constexpr int kDamages = 25;
  for (int seed = 1; seed <= runs; ++seed) {
    LiveRun run(static_cast<std::uint64_t>(seed), "coordinated");
    run.run(800);
    Damage damage(static_cast<std::uint64_t>(seed));
    for (int i = 0; i < kDamages; ++i) {
      std::vector<std::string> log = run.log;
      std::string& line = log[damage.below(log.size())];
      damage.to_line(line);
      SCOPED_TRACE("seed " + std::to_string(seed) + ": " + line.substr(0, 300));
      const auto time = Replay::time_of(line);
      if (time && *time > run.ended_at() + 1min && *time < TimePoint(32 * 24h))
        continue;  // valid, but would replay for days
      bool whole = false;
      EXPECT_NO_THROW(whole = is_taken_whole(log));
      if (!whole) ++refused;
    }
  }
  EXPECT_GT(refused, runs * kDamages / 2);
}

}  // namespace
}  // namespace armloom
