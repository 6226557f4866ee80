#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "server/recording/recording.h"
#include "test/server/panda_jobs.h"
#include "test/source_dir.h"

namespace armloom::test {

inline const std::filesystem::path kSource = source_dir();
inline const std::string kCell = (kSource / "config/two_pandas.json").string();

struct Outcome {
  int exit_code;
  std::string out;
  std::string err;
  [[nodiscard]] nlohmann::json last_line() const {
    const std::size_t end = out.find_last_not_of('\n');
    const std::size_t begin = out.rfind('\n', end);
    return nlohmann::json::parse(out.substr(begin == out.npos ? 0 : begin + 1));
  }
};

// Runs the binary through a shell, with a separate folder for each test.
class CommandFixture : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / "armloom-command" /
              test->test_suite_name() / test->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  Outcome run(const std::string& arguments) const {
    const std::string command = std::string(ARMLOOM_BINARY) + " " + arguments + " >" +
                                (folder_ / "out").string() + " 2>" + (folder_ / "err").string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text_file(folder_ / "out").value(),
            read_text_file(folder_ / "err").value()};
  }
  // Writes the two-Panda cell with one value replaced and absolute paths.
  std::filesystem::path changed_cell(const std::string& pointer,
                                     const nlohmann::json& value) const {
    nlohmann::json cell = nlohmann::json::parse(read_text_file(kCell).value(), nullptr, true, true);
    for (nlohmann::json& robot : cell["robots"]) {
      robot["urdf"] = (kSource / "models/panda.urdf").string();
      robot["srdf"] = (kSource / "models/panda.srdf").string();
    }
    cell[nlohmann::json::json_pointer(pointer)] = value;
    return file("cell.json", cell.dump());
  }
  // Writes four jobs that start at once: j0, j1 of the left arm and j2, j3 of the right arm, each
  // to the middle and back.
  std::filesystem::path conflicting_jobs() const {
    nlohmann::json jobs = nlohmann::json::array();
    int number = 0;
    for (const char* arm : {"left", "right"}) {
      for (const auto& [from, to] : {std::pair{kHome, kMiddle}, {kMiddle, kHome}}) {
        nlohmann::json job = move(arm, from, to);
        job["id"] = "j" + std::to_string(number++);
        jobs.push_back({{"at", 0.0}, {"job", job}});
      }
    }
    return file("jobs.json", jobs.dump());
  }

  std::filesystem::path folder_;
};

}  // namespace armloom::test
