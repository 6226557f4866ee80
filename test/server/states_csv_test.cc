#include "server/recording/states_csv.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/model/cell/build_cell.h"
#include "server/codec/cell_codec.h"
#include "server/recording/recording.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

CellPtr two_pandas() {
  const fs::path file = fs::path(source_dir()) / "config/two_pandas.json";
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
  std::vector<std::string> warnings;
  const auto states = read_states(file, *cell, &warnings);
  ASSERT_TRUE(states) << states.error().front().detail;
  ASSERT_EQ(states->size(), 3U);
  EXPECT_EQ(warnings.size(), 2U) << "two holes of a second";
  EXPECT_EQ((*states)[2].time, at(std::chrono::nanoseconds(2'000'000'001)));
  EXPECT_LT(((*states)[0].q - q).cwiseAbs().maxCoeff(), 0.6e-9);

  for (const std::size_t cut : {1U, 5U, 40U}) {  // killed while writing a row
    std::ofstream(file) << text.substr(0, text.size() - cut);
    warnings.clear();
    const auto begun = read_states(file, *cell, &warnings);
    ASSERT_TRUE(begun);
    EXPECT_EQ(begun->size(), 2U);
    EXPECT_EQ(
        warnings.back(),
        "states.csv:4: the last row has no line end: the recording was cut off there, the row is "
        "ignored");
  }
}

// A row to write: time, position of the left arm's first joint, and whether the arms are at rest.
struct Row {
  int at_ms;
  double q0;
  bool at_rest;
};
fs::path recorded(const Cell& cell, const std::vector<Row>& rows) {
  fs::path file = folder_of_test() / "states.csv";
  StatesWriter writer(file, cell);
  Configuration q = cell.home();
  for (const Row& row : rows) {
    writer.at_rest(row.at_rest);
    q[0] = row.q0;
    writer.write(at(std::chrono::milliseconds(row.at_ms)), q);
  }
  return file;
}
std::vector<std::int64_t> times_ms(const std::vector<RecordedState>& states) {
  std::vector<std::int64_t> times;
  for (const RecordedState& s : states) times.push_back(s.time.time_since_epoch() / 1'000'000ns);
  return times;
}
using Times = std::vector<std::int64_t>;
using Warnings = std::vector<std::string>;

TEST(IdleStretches, KeepTheirFirstAndLastRowAndAreListed) {
  const CellPtr cell = two_pandas();
  std::vector<Row> rows;
  for (int ms = 1; ms <= 500; ++ms) rows.push_back({ms, 0.0, true});
  for (int ms = 501; ms <= 503; ++ms) rows.push_back({ms, 0.001 * (ms - 500), false});
  for (int ms = 504; ms <= 900; ++ms) rows.push_back({ms, 0.003 + 1e-5 * (ms % 7), true});  // noise
  const fs::path file = recorded(*cell, rows);
  EXPECT_EQ(read_text_file(idle_file_of(file)).value(), "from_s,to_s\n0.001,0.500\n0.504,0.900\n");
  Warnings warnings;
  const auto states = read_states(file, *cell, &warnings);
  ASSERT_TRUE(states);
  EXPECT_EQ(times_ms(*states), (Times{1, 500, 501, 502, 503, 504, 900}));
  EXPECT_EQ(warnings, Warnings{});
  std::vector<bool> after_rest;
  for (const RecordedState& s : *states) after_rest.push_back(s.after_rest);
  EXPECT_EQ(after_rest, (std::vector<bool>{false, true, false, false, false, false, true}));
}

TEST(IdleStretches, CanBeReadWhileTheyLast) {
  const CellPtr cell = two_pandas();
  const fs::path file = folder_of_test() / "states.csv";
  StatesWriter writer(file, *cell);
  writer.at_rest(true);
  const auto rest = [&](int from_ms, int to_ms) {
    for (int ms = from_ms; ms <= to_ms; ++ms) {
      writer.write(at(std::chrono::milliseconds(ms)), cell->home());
    }
  };
  Warnings warnings;
  rest(1, 300);
  writer.catch_up();
  EXPECT_EQ(times_ms(*read_states(file, *cell, &warnings)), (Times{1, 300}));
  writer.catch_up();
  rest(301, 500);
  EXPECT_TRUE(writer.close());
  EXPECT_EQ(times_ms(*read_states(file, *cell, &warnings)), (Times{1, 300, 301, 500}));
  EXPECT_EQ(warnings, Warnings{});
}

TEST(IdleStretches, OmitNothingIfShorterThanThreeRows) {
  const CellPtr cell = two_pandas();
  const fs::path file =
      recorded(*cell, {{1, 0, true}, {2, 0, true}, {3, 0.1, false}, {4, 0, true}});
  EXPECT_EQ(times_ms(*read_states(file, *cell)), (Times{1, 2, 3, 4}));
  EXPECT_FALSE(fs::exists(idle_file_of(file)));
}

// A joint that moves without a command is recorded row by row.
TEST(IdleStretches, EndIfAJointMoves) {
  const CellPtr cell = two_pandas();
  ASSERT_EQ(cell->checking.tracking_error_rad, 0.001);
  std::vector<Row> rows;
  for (int ms = 1; ms <= 200; ++ms) rows.push_back({ms, 0.0, true});
  for (int ms = 201; ms <= 203; ++ms) rows.push_back({ms, 0.005 * (ms - 200), true});
  for (int ms = 204; ms <= 400; ++ms) rows.push_back({ms, 0.015, true});
  const fs::path file = recorded(*cell, rows);
  Warnings warnings;
  EXPECT_EQ(times_ms(*read_states(file, *cell, &warnings)), (Times{1, 200, 201, 202, 203, 400}));
  EXPECT_EQ(warnings, Warnings{});
}

// Rows may be lost between rows, at the end, or after a motion. They are never taken for a rest.
TEST(IdleStretches, DoNotHideLostRows) {
  const CellPtr cell = two_pandas();
  std::vector<Row> rows;
  for (int ms = 1; ms <= 200; ++ms) rows.push_back({ms, 0.0, true});
  for (int ms = 201; ms <= 400; ++ms) rows.push_back({ms, 0.001 * (ms - 200), false});
  for (int ms = 401; ms <= 600; ++ms) rows.push_back({ms, 0.2, true});
  const fs::path file = recorded(*cell, rows);
  const std::string text = read_text_file(file).value();
  const auto from_row = [&](const std::string& time) { return text.find("\n" + time) + 1; };
  const auto warnings_of = [&](const std::string& changed) {
    std::ofstream(file) << changed;
    Warnings warnings;
    EXPECT_TRUE(read_states(file, *cell, &warnings));
    return warnings;
  };
  EXPECT_EQ(warnings_of(text), Warnings{});
  const std::string hole = text.substr(0, from_row("0.250")) + text.substr(from_row("0.350"));
  EXPECT_EQ(warnings_of(hole).size(), 1U) << "the motion has a hole";
  const std::string cut = text.substr(0, from_row("0.300"));
  EXPECT_EQ(warnings_of(cut),
            Warnings{"states.csv:102: rows are missing: states_idle.csv continues"});
  const std::string no_begin = text.substr(0, from_row("0.200")) + text.substr(from_row("0.230"));
  EXPECT_EQ(warnings_of(no_begin).size(), 2U) << "the rest has no end, and there is a hole";

  std::ofstream(idle_file_of(file)) << "from_s,to_s\n0.001,0.200\n0.401,0.600\n0.700,0.650\n";
  const auto states = read_states(file, *cell);
  ASSERT_FALSE(states);
  EXPECT_EQ(states.error().front().pointer, "states_idle.csv:4");
  std::ofstream(idle_file_of(file)) << "from_s,to_s\n0.001,0.200\n0.210,0.400\n";
  Warnings warnings;
  std::ofstream(file) << text.substr(0, from_row("0.211")) + text.substr(from_row("0.400"));
  ASSERT_TRUE(read_states(file, *cell, &warnings));
  EXPECT_NE(warnings.at(0).find("arms moved in a stretch recorded as idle"), std::string::npos);
}

struct BadRecording {
  const char* name;
  int line;          // line to change, from one
  const char* from;  // old text
  const char* to;    // new text
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

TEST(StatesCsv, RefusesMissingAndEmptyFiles) {
  const CellPtr cell = two_pandas();
  const fs::path folder = folder_of_test();
  EXPECT_FALSE(read_states(folder / "nothing.csv", *cell));
  std::ofstream(folder / "empty.csv").flush();
  EXPECT_FALSE(read_states(folder / "empty.csv", *cell));
  { StatesWriter writer(folder / "header.csv", *cell); }
  EXPECT_FALSE(read_states(folder / "header.csv", *cell));
}

TEST(Recording, HasEverythingForARerun) {
  const CellPtr cell = two_pandas();
  const fs::path folder = folder_of_test() / "made" / "on the way";
  const fs::path cell_file = fs::path(source_dir()) / "config/two_pandas.json";
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
