#include "test/physics/recorded_contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "core/trajectory/joint_line.h"
#include "server/recording/states_csv.h"
#include "test/physics/physics_cells.h"

namespace armloom::test {
namespace {

using namespace std::chrono_literals;

// Records both Pandas moving from home on straight lines until they have hit each other, and reads
// the recording back.
std::vector<RecordedState> recorded_crash(const CellPtr& cell) {
  std::vector<JointId> joints;
  Configuration goal = cell->home();
  for (std::uint32_t j = 0; j < cell->joints.size(); ++j) {
    joints.emplace_back(j);
    if (cell->joints[j].name.ends_with("joint2")) goal[j] = 0.6;
    if (cell->joints[j].name.ends_with("joint4")) goal[j] = -1.6;
  }
  const auto line = joint_line(*cell, joints, cell->home(), goal);
  if (!line) throw std::runtime_error(line.error().front().detail);
  const auto folder = std::filesystem::path(testing::TempDir()) / "armloom_recorded_crash";
  std::filesystem::create_directories(folder);
  StatesWriter writer(folder / "states.csv", *cell);
  Eigen::VectorXd q;
  for (Duration t{}; t <= (*line)->duration(); t += 1ms) {
    (*line)->sample_positions(t, q);
    writer.write(TimePoint(t), q);
  }
  writer.close();
  auto read = read_true_states(folder, *cell);
  std::filesystem::remove_all(folder);
  if (!read) throw std::runtime_error(read.error().front().detail);
  return read->states;
}

TEST(RecordedContacts, BeginWhenTheArmsHitEachOther) {
  const CellPtr cell = config_cell("two_pandas_physics");
  auto states = recorded_crash(cell);
  const auto contacts = find_contacts(cell, states);
  ASSERT_FALSE(contacts.empty());
  EXPECT_THAT(contacts.front().bodies.body_a, testing::StartsWith("left_"));
  EXPECT_THAT(contacts.front().bodies.body_b, testing::StartsWith("right_"));
  const auto report = audit(*cell, states, 1ms);
  ASSERT_TRUE(report.has_value() && report->first_contact.has_value());
  EXPECT_LE(std::abs(to_seconds(contacts.front().time - report->first_contact->time)), 0.003);

  std::erase_if(states, [&](const RecordedState& state) {
    return state.time >= report->first_contact->time - 3ms;
  });
  ASSERT_GT(states.size(), 100u);
  EXPECT_TRUE(find_contacts(cell, states).empty());
}

}  // namespace
}  // namespace armloom::test
