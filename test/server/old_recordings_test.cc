#include "server/recording/old_recordings.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <future>
#include <string>

namespace armloom {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class RecordingRetention : public ::testing::Test {
 protected:
  void SetUp() override {
    data_ = fs::path(::testing::TempDir()) / "armloom-old-recordings" /
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(data_);
    fs::create_directories(data_);
  }
  fs::path recording(const std::string& name, std::chrono::hours ago, std::size_t bytes = 100) {
    const fs::path folder = name.empty() ? data_ : data_ / name;
    fs::create_directories(folder);
    fs::create_directories(folder / "files");
    for (const char* file : {"events.jsonl", "cell.json", "jobs.json", "files/arm.stl"}) {
      std::ofstream(folder / file) << std::string(bytes / 4, ' ');
      fs::last_write_time(folder / file, now_ - ago);
    }
    return folder;
  }
  std::vector<std::string> removed(const RecordingBounds& bounds, const fs::path& running) {
    std::vector<std::string> names;
    for (const auto& one : remove_old_recordings(data_, bounds, {running}, now_)) {
      EXPECT_EQ(one.fault, "");
      names.push_back(one.folder == data_ ? "" : one.folder.filename().string());
    }
    return names;
  }
  const fs::file_time_type now_ = fs::file_time_type::clock::now();
  fs::path data_;
};
using Names = std::vector<std::string>;
const std::string kFirst = "2026-11-01T09-00-00Z", kSecond = "2026-11-02T09-00-00Z.2",
                  kThird = "2026-11-03T09-00-00Z";

TEST_F(RecordingRetention, RemovesTheOldestBeyondTheCount) {
  recording("", 100h);
  recording(kFirst, 72h);
  recording(kSecond, 48h);
  const fs::path running = recording(kThird, 0h);
  std::ofstream(data_ / "armloom.db") << "jobs";
  EXPECT_EQ(removed({}, running), Names{}) << "without bounds all stay";
  EXPECT_EQ(removed({.count = 4}, running), Names{});
  EXPECT_EQ(removed({.count = 2}, running), (Names{"", kFirst}));
  EXPECT_TRUE(fs::exists(data_ / "armloom.db")) << "of the data folder itself only the recording";
  EXPECT_FALSE(fs::exists(data_ / "events.jsonl") || fs::exists(data_ / "files"));
  EXPECT_FALSE(fs::exists(data_ / kFirst));
  EXPECT_TRUE(fs::exists(data_ / kSecond / "events.jsonl"));
}

TEST_F(RecordingRetention, RemovesByTimeOfLastWrite) {
  recording(kFirst, 24h * 31);
  recording(kSecond, 24h * 29);
  EXPECT_EQ(removed({.age = std::chrono::days(30)}, data_), Names{kFirst});
}

TEST_F(RecordingRetention, EnforcesTotalSize) {
  recording(kFirst, 3h, 400);
  recording(kSecond, 2h, 400);
  const fs::path running = recording(kThird, 0h, 400);
  EXPECT_EQ(removed({.bytes = 1200}, running), Names{});
  EXPECT_EQ(removed({.bytes = 800}, running), Names{kFirst});
  EXPECT_EQ(removed({.bytes = 1}, running), Names{kSecond}) << "never the running one";
  EXPECT_TRUE(fs::exists(running / "events.jsonl"));
}

TEST_F(RecordingRetention, KeepsForeignFilesAndFolders) {
  const fs::path running = recording(kThird, 0h);
  recording("2026-11-01T09-00-00Z-keep", 99h);
  recording("for the report", 99h);
  fs::create_directories(data_ / kFirst);  // without events
  fs::create_directory_symlink(data_ / "for the report", data_ / kSecond);
  const fs::path full = recording("2026-11-02T10-00-00Z", 50h);
  std::ofstream(full / "notes.txt") << "of the user";
  EXPECT_EQ(removed({.count = 1}, running), Names{"2026-11-02T10-00-00Z"});
  EXPECT_TRUE(fs::exists(full / "notes.txt"));
  EXPECT_TRUE(fs::exists(data_ / "for the report" / "events.jsonl"));
  EXPECT_TRUE(fs::exists(data_ / "2026-11-01T09-00-00Z-keep" / "events.jsonl"));
}

TEST_F(RecordingRetention, RunsPeriodicallyInTheServer) {
  const fs::path running = recording(kThird, 0h);
  recording(kFirst, 72h);
  std::promise<std::string> told;
  const OldRecordings old({data_, {running}}, {.count = 1}, 10ms,
                          [&](const RemovedRecording& gone) { told.set_value(gone.folder); });
  EXPECT_EQ(told.get_future().get(), (data_ / kFirst).string());
}

}  // namespace
}  // namespace armloom
