#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <vector>

#include "server/api/recording_files.h"
#include "test/server/durable_server.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kList = "/api/v1/recordings";
const std::string kFormer = "2026-11-21T09-33-00Z";

std::string text_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Recordings : public Durable {
 protected:
  fs::path former(const std::string& name = kFormer) {
    fs::create_directories(data_ / name / "files");
    write(name + "/events.jsonl", "{}\n");
    write(name + "/files/arm.stl", "copied");
    return data_ / name;
  }
  void write(const std::string& file, const std::string& text) {
    std::ofstream(data_ / file, std::ios::binary) << text;
  }
  json listed(const std::string& name) {
    const json list = get(kList).json();
    for (const json& one : list["recordings"]) {
      if (one["name"] == name) return one;
    }
    return nullptr;
  }
  static std::set<std::string> files_of(const json& recording) {
    std::set<std::string> names;
    for (const json& file : recording["files"]) names.insert(file["name"].get<std::string>());
    return names;
  }
  test::Answer file(const std::string& name, const std::string& file) {
    return get(std::string(kList) + "/" + name + "/" + file);
  }
};

TEST_F(Recordings, AreListedNewestFirstWithTheirFiles) {
  options_.record_states = true;
  start(1);
  former();
  fs::last_write_time(data_ / kFormer / "events.jsonl",
                      fs::file_time_type::clock::now() - std::chrono::hours(24));
  write("2026-11-21T09-33-00Z-copied", "no folder");
  const json list = get(kList).json();
  EXPECT_EQ(list["kept"], true);
  ASSERT_EQ(list["recordings"].size(), 2U) << list;
  const json running = list["recordings"][0], ended = list["recordings"][1];
  EXPECT_EQ(running["name"], "data");
  EXPECT_EQ(running["running"], true);
  EXPECT_EQ(running["has_states"], true);
  const auto files = files_of(running);
  EXPECT_TRUE(files.contains("states.csv") && files.contains("cell.json") &&
              files.contains("inputs.jsonl"))
      << running;
  EXPECT_EQ(ended["name"], kFormer);
  EXPECT_EQ(ended["running"], false);
  EXPECT_EQ(ended["has_states"], false);
  EXPECT_EQ(ended["files"], json::parse(R"([{"name": "events.jsonl", "bytes": 3}])"));
  EXPECT_TRUE(ended["begun_at"].is_null()) << "it has no cell.json";
  EXPECT_LT(ended["written_at"], running["begun_at"]);
  EXPECT_LE(running["begun_at"], running["written_at"]);
}

TEST_F(Recordings, AreServedByteForByteAfterARestart) {
  start(20);
  ASSERT_EQ(submit("swing").status, 202);
  wait_for("swing", "succeeded");
  restart();
  std::size_t compared = 0;
  for (const std::string& name : files_of(listed("data"))) {
    const auto answer = file("data", name);
    EXPECT_EQ(answer.status, 200) << name;
    EXPECT_EQ(answer.body, text_of_file(data_ / name)) << name;
    EXPECT_EQ(answer.headers.at("content-disposition"),
              "attachment; filename=\"data-" + name + "\"");
    ++compared;
  }
  EXPECT_GE(compared, 4U);
}

TEST_F(Recordings, InProgressAreServedUpToTheLastLine) {
  options_.record_states = true;
  start(20);
  ASSERT_EQ(submit("swing").status, 202);
  wait_for("swing", "succeeded");
  const double ended_s = job("swing")["ended_s"];
  const std::string states = file("data", "states.csv").body;
  ASSERT_TRUE(states.starts_with("time_s,left_panda_joint1,")) << states.substr(0, 80);
  EXPECT_EQ(states.back(), '\n');
  const std::size_t last = states.rfind('\n', states.size() - 2) + 1;
  EXPECT_GT(std::stod(states.substr(last)), ended_s - 0.1)
      << "what was measured last is still in the memory of the server";
  // An incomplete line is left for the next download.
  const std::string events = file("data", "events.jsonl").body;
  std::ofstream(data_ / "events.jsonl", std::ios::app) << std::string(200'000, 'x');
  EXPECT_TRUE(file("data", "events.jsonl").body.starts_with(events));
  EXPECT_EQ(file("data", "events.jsonl").body.find('x', events.size()), std::string::npos);
  restart();
  EXPECT_NE(file("data", "events.jsonl").body.find("xxx"), std::string::npos)
      << "of one that has ended all is handed out";
}

TEST_F(Recordings, NoOtherFileIsServed) {
  start(1);
  former();
  const std::string secret = "secret\n";
  write("secret.txt", secret);
  write(kFormer + "/notes.txt", secret);
  fs::create_directories(data_ / "elsewhere");
  write("elsewhere/events.jsonl", secret);
  const std::string linked = "2026-11-22T09-33-00Z", with_links = "2026-11-23T09-33-00Z";
  fs::create_directory_symlink(data_ / "elsewhere", data_ / linked);
  former(with_links);
  fs::create_symlink(data_ / "elsewhere/events.jsonl", data_ / with_links / "states.csv");
  fs::create_directories(data_ / with_links / "jobs.json");
  EXPECT_TRUE(listed(linked).is_null());
  EXPECT_EQ(files_of(listed(with_links)), std::set<std::string>{"events.jsonl"});
  const std::vector<std::string> paths = {"data/armloom.db",
                                          "data/armloom.db-wal",
                                          "data/secret.txt",
                                          "data/..",
                                          "data/",
                                          "../data/events.jsonl",
                                          "data/../secret.txt",
                                          "elsewhere/events.jsonl",
                                          "./events.jsonl",
                                          "../events.jsonl",
                                          "%2e%2e/events.jsonl",
                                          "data%2f..%2felsewhere/events.jsonl",
                                          "data/..%2fsecret.txt",
                                          "data/%2e%2e%5csecret.txt",
                                          "data/events.jsonl%00.txt",
                                          "%2fetc/passwd",
                                          kFormer + "/notes.txt",
                                          kFormer + "/states.csv",
                                          kFormer + "/files",
                                          kFormer + "/files/arm.stl",
                                          kFormer + "/files%2farm.stl",
                                          kFormer + "/../secret.txt",
                                          kFormer + "x/events.jsonl",
                                          kFormer + "/events.jsonl/",
                                          linked + "/events.jsonl",
                                          with_links + "/states.csv",
                                          with_links + "/jobs.json"};
  for (const std::string& path : paths) {
    const auto answer = get(std::string(kList) + "/" + path);
    EXPECT_TRUE(answer.status == 404 || answer.status == 400) << path << ": " << answer.status;
    EXPECT_EQ(answer.body.find(secret), std::string::npos) << path;
    EXPECT_EQ(answer.body.find(data_.string()), std::string::npos) << path;
  }
  EXPECT_EQ(file(kFormer, "events.jsonl").body, "{}\n");
}

TEST_F(Recordings, AreServedFromALinkedDataFolder) {
  fs::create_directories(data_.parent_path());
  const fs::path link = data_.string() + "-link";
  fs::remove(link);
  fs::create_directories(data_);
  fs::create_directory_symlink(data_, link);
  options_.data = link;
  start(1);
  EXPECT_EQ(listed("data")["running"], true);
  EXPECT_EQ(file("data", "cell.json").body, text_of_file(data_ / "cell.json"));
}

constexpr std::uintmax_t kLarge = std::uintmax_t{6} << 30U;

// A sparse file uses no disk space.
void make_large(const fs::path& file, std::uintmax_t bytes) {
  std::ofstream(file, std::ios::binary) << "time_s\n";
  fs::resize_file(file, bytes);
}

std::string asking_for(const std::string& name, const std::string& verb = "GET") {
  return verb + " " + kList + "/" + name + "/states.csv HTTP/1.1\r\nHost: localhost\r\n\r\n";
}

TEST_F(Recordings, LargeFileIsStreamed) {
  start(1);
  make_large(former() / "states.csv", kLarge);
  test::Wire wire(port());
  wire.send(asking_for(kFormer));
  const std::string head = wire.take_until("\r\n\r\n");
  EXPECT_NE(head.find("Content-Length: " + std::to_string(kLarge)), head.npos) << head;
  EXPECT_TRUE(wire.take(std::size_t{3} << 20U).starts_with("time_s\n"));
  EXPECT_EQ(get("/api/v1/arms").status, 200) << "others are served meanwhile";
  test::Wire asking(port());
  asking.send(asking_for(kFormer, "HEAD"));
  const auto told = test::read_answer(asking, true);
  EXPECT_EQ(told.headers.at("content-length"), std::to_string(kLarge));
  asking.send(asking_for(kFormer, "HEAD"));
  EXPECT_EQ(test::read_answer(asking, true).status, 200) << "and the connection goes on";
}

TEST_F(Recordings, FileThatShrinksEndsTheConnection) {
  start(1);
  const fs::path file = former() / "states.csv";
  make_large(file, kLarge);
  test::Wire wire(port());
  wire.send(asking_for(kFormer));
  wire.take_until("\r\n\r\n");
  fs::resize_file(file, 100'000);
  EXPECT_LT(wire.take_all().size(), std::size_t{1} << 30U);
}

TEST_F(Recordings, SimultaneousDownloadsAreBounded) {
  start(1);
  make_large(former() / "states.csv", kLarge);
  std::vector<std::unique_ptr<test::Wire>> readers;
  for (std::size_t i = 0; i < RecordingFiles::kOpenMax; ++i) {
    readers.push_back(std::make_unique<test::Wire>(port(), 4096));
    readers.back()->send(asking_for(kFormer));
    EXPECT_NE(readers.back()->take_until("\r\n\r\n").find("200 OK"), std::string::npos) << i;
  }
  const auto refused = file(kFormer, "events.jsonl");
  EXPECT_EQ(refused.status, 503);
  EXPECT_EQ(refused.headers.at("retry-after"), "1");
  readers.pop_back();
  wait_until([&] { return file(kFormer, "events.jsonl").status == 200; });
}

TEST(RecordingFiles, AreEmptyWithoutADataFolder) {
  const RecordingFiles none(std::nullopt, nullptr);
  EXPECT_FALSE(none.list().is_kept);
  EXPECT_FALSE(none.is_running("data"));
  EXPECT_EQ(none.open("data", "events.jsonl").error(), NoFile::absent);
}

using Alone = test::RunningServer;
TEST_F(Alone, ServerWithoutADataFolderKeepsNoRecordings) {
  start(1);
  EXPECT_EQ(get(kList).json(), json::parse(R"({"kept": false, "recordings": []})"));
  EXPECT_EQ(get(std::string(kList) + "/data/events.jsonl").status, 404);
}

}  // namespace
}  // namespace armloom
