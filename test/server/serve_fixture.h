#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "test/server/command_fixture.h"
#include "test/server/serve_process.h"

namespace armloom::test {

// The server as a process, with a folder for data and log.
class Serve : public CommandFixture {
 protected:
  std::string log() const { return (folder_ / "log").string(); }
  std::string data() const { return (folder_ / "data").string(); }
  static nlohmann::json begin_job(std::uint16_t port, const std::string& id,
                                  const std::string& arm) {
    nlohmann::json job = move(arm, kHome, kMiddle);
    job["id"] = id;
    const auto answer = request(port, "POST", "/api/v1/jobs", job.dump());
    EXPECT_EQ(answer.status, 202) << answer.body;
    return job;
  }
  // Returns all events of the recording; every line must be complete.
  std::vector<nlohmann::json> events() const {
    std::vector<nlohmann::json> all;
    std::ifstream in(folder_ / "data/events.jsonl");
    for (std::string line; std::getline(in, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
  static bool has_ended(const nlohmann::json& event, const std::string& id) {
    return event["type"] == "job" && event["data"]["id"] == id &&
           !event["data"]["result"].is_null();
  }
};

}  // namespace armloom::test
