#include "server/recording/states_csv.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/model/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/recording/recording.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

CellPtr two_pandas() {
  const fs::path file = fs::path(ARMLOOM_SOURCE_DIR) / "config/two_pandas.json";
  return build_cell(read_cell_text(read_text_file(file).value(), file.parent_path()).value())
      .value();
}

fs::path folder_of_test() {
  const fs::path folder = fs::path(::testing::TempDir()) / "armloom" /
                          ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::create_directories(folder);
  return folder;
}

TEST(StatesCsv, ReadsBackWhatItWrote) {
  const CellPtr cell = two_pandas();
  const fs::path file = folder_of_test() / "states.csv";
  Configuration q = cell->home();
  q[0] = -0.123456789;
  q[3] = -1e-10;  // rounds to zero
  {
    StatesWriter writer(file, *cell);
    writer.write(at(std::chrono::milliseconds(1)), q);
    writer.write(at(std::chrono::milliseconds(1002)), cell->home());
    writer.write(at(std::chrono::nanoseconds(2'000'000'001)), q);
  }
  const std::string text = read_text_file(file).value();
  EXPECT_NE(text.find("\n0.001,-0.123456789,"), std::string::npos);
  EXPECT_NE(text.find("\n1.002,0.000000000,-1.200000000,"), std::string::npos);
  EXPECT_EQ(text.find("-0.000000000"), std::string::npos);
  std::vector<std::string> doubts;
  const auto states = read_states(file, *cell, &doubts);
  ASSERT_TRUE(states) << states.error().front().detail;
  ASSERT_EQ(states->size(), 3U);
  EXPECT_EQ(doubts.size(), 2U) << "two holes of a second";
  EXPECT_EQ((*states)[2].time, at(std::chrono::nanoseconds(2'000'000'001)));
  EXPECT_LT(((*states)[0].q - q).cwiseAbs().maxCoeff(), 0.6e-9);

  std::ofstream(file) << text.substr(0, text.size() - 5);  // killed while it wrote
  doubts.clear();
  ASSERT_TRUE(read_states(file, *cell, &doubts));
  EXPECT_EQ(doubts.back(), "states.csv:4: the last row has no end of line and may be cut off");
}

struct BadRecording {
  const char* name;
  int line;          // to replace, from one
  const char* from;  // its text ...
  const char* to;    // ... becomes this
  const char* place;
  const char* says;
};

void PrintTo(const BadRecording& bad, std::ostream* out) { *out << bad.name; }

class BadStates : public ::testing::TestWithParam<BadRecording> {};

TEST_P(BadStates, AreRefusedWithLineAndColumn) {
  const CellPtr cell = two_pandas();
  const fs::path file =
      fs::path(::testing::TempDir()) / (std::string("armloom-") + GetParam().name + ".csv");
  {
    StatesWriter writer(file, *cell);
    for (int tick = 1; tick <= 3; ++tick) {
      writer.write(at(std::chrono::milliseconds(tick)), cell->home());
    }
  }
  std::string text = read_text_file(file).value();
  std::size_t begin = 0;
  for (int line = 1; line < GetParam().line; ++line) begin = text.find('\n', begin) + 1;
  const std::size_t found = text.find(GetParam().from, begin);
  ASSERT_NE(found, std::string::npos);
  text.replace(found, std::string(GetParam().from).size(), GetParam().to);
  std::ofstream(file) << text;

  const auto states = read_states(file, *cell);
  fs::remove(file);
  ASSERT_FALSE(states);
  const Problem& problem = states.error().front();
  EXPECT_NE(problem.pointer.find(GetParam().place), std::string::npos) << problem.pointer;
  EXPECT_NE(problem.detail.find(GetParam().says), std::string::npos) << problem.detail;
}

INSTANTIATE_TEST_SUITE_P(
    Table, BadStates,
    ::testing::Values(
        BadRecording{"NoTime", 1, "time_s", "t", ":1", "time_s"},
        BadRecording{"UnknownJoint", 1, "left_panda_joint3", "left_panda_joint9", ":1",
                     "no joint of the cell"},
        BadRecording{"TwoColumns", 1, "left_panda_joint3", "left_panda_joint2", ":1",
                     "two columns"},
        BadRecording{"NoColumn", 1, ",right_panda_finger_joint1", "", ":1", "no column"},
        BadRecording{"ShortRow", 3, "0.002,", "", ":3", "fields"},
        BadRecording{"NotANumber", 3, "-1.200000000", "nan", ":3 left_panda_joint2", "finite"},
        BadRecording{"Rest", 3, "-1.200000000", "-1.2x", ":3 left_panda_joint2", "finite"},
        BadRecording{"TimeStands", 4, "0.003", "0.002", ":4 time_s", "increase"}),
    [](const auto& tested) { return tested.param.name; });

TEST(StatesCsv, MissingAndEmptyFilesAreSaid) {
  const CellPtr cell = two_pandas();
  const fs::path folder = folder_of_test();
  EXPECT_FALSE(read_states(folder / "nothing.csv", *cell));
  std::ofstream(folder / "empty.csv").flush();
  EXPECT_FALSE(read_states(folder / "empty.csv", *cell));
  { StatesWriter writer(folder / "header.csv", *cell); }
  EXPECT_FALSE(read_states(folder / "header.csv", *cell));
}

TEST(Recording, HoldsEverythingThatARerunNeeds) {
  const CellPtr cell = two_pandas();
  const fs::path folder = folder_of_test() / "made" / "on the way";
  const fs::path cell_file = fs::path(ARMLOOM_SOURCE_DIR) / "config/two_pandas.json";
  {
    auto recording =
        Recording::create(folder, {cell_file, read_text_file(cell_file).value()}, *cell, true);
    ASSERT_TRUE(recording);
    (*recording)->event(R"({"seq":1})");
    (*recording)->state(at(std::chrono::milliseconds(1)), cell->home());
    (*recording)->job(at(std::chrono::milliseconds(1)), R"({"id":"a"})");
    (*recording)->job(at(std::chrono::milliseconds(2)), R"({"id":"b"})");
  }
  EXPECT_EQ(read_text_file(folder / "events.jsonl").value(), "{\"seq\":1}\n");
  EXPECT_EQ(
      read_text_file(folder / "jobs.json").value(),
      "[\n{\"at\":0.001,\"job\":{\"id\":\"a\"}},\n{\"at\":0.002,\"job\":{\"id\":\"b\"}}\n]\n");
  EXPECT_TRUE(read_states(folder / "states.csv", *cell));
  EXPECT_TRUE(read_cell_text(read_text_file(folder / "cell.json").value(), folder));
}

}  // namespace
}  // namespace armloom
