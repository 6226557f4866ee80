// More goals than can all be reached, for more arms than have room: every job must still end.
#include <algorithm>
#include <random>

#include "test/scenarios/seeds.h"
#include "test/scenarios/two_gantries.h"

namespace armloom {
namespace {

constexpr std::size_t kCrowd = 6;
constexpr std::size_t kGoalsInAll = 24;
constexpr double kPitch_m = 0.3;

// Four columns and three rows between walls: arms can pass each other only where a place is free.
std::vector<Place_m> all_places() {
  std::vector<Place_m> places;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      places.emplace_back(-0.6 + kPitch_m * column, -0.45 + kPitch_m * row);
    }
  }
  return places;
}

class CrowdedGoals : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Policies, CrowdedGoals, ::testing::ValuesIn(known_policies()));

TEST_P(CrowdedGoals, EveryJobEnds) {
  int succeeded = 0;
  for (std::uint64_t seed = 1; seed <= seed_count(2); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<Place_m> places = all_places();
    for (std::size_t i = places.size() - 1; i > 0; --i) {
      std::swap(places[i], places[random() % (i + 1)]);
    }
    CellDescription description =
        gantries(OnIdleBlocker::park, {places.begin(), places.begin() + kCrowd});
    put_walls(description, {-0.9, 0.6, -0.75, 0.45});
    description.scheduling.aging = std::chrono::seconds(random() % 2 == 0 ? 2 : 5);
    for (RobotDescription& robot : description.robots) {
      for (const char* joint : {"x", "y"}) robot.arms.front().limits[joint].acceleration = 2.0;
    }
    TwoGantries cell(description, GetParam());
    for (std::size_t i = 0; i < kGoalsInAll; ++i) {
      JobRequest goal = to_place(std::string(1, static_cast<char>('a' + i % kCrowd)),
                                 places[random() % places.size()], "goal " + std::to_string(i));
      goal.speed = random() % 2 == 0 ? 0.1 : 0.3;
      cell.submit(std::move(goal));
    }
    cell.run_to_the_end(at(3000s));
    for (std::size_t i = 0; i < kGoalsInAll; ++i) {
      const JobState end = cell.job("goal " + std::to_string(i)).state;
      EXPECT_TRUE(is_terminal(end)) << "goal " << i << " is " << to_string(end);
      succeeded += end == JobState::succeeded ? 1 : 0;
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(succeeded, 10);
}

}  // namespace
}  // namespace armloom
