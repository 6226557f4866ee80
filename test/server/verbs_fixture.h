#pragma once

#include <gtest/gtest.h>

#include <string>

#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"

namespace armloom::test {

inline constexpr Pose kAside{1.2, -1.2, 0, -2.6, 0, 1.6, 0.785};  // turned away from the other arm

// Helpers for tests of routes beyond /jobs.
class VerbsFixture : public RunningServer {
 protected:
  static nlohmann::json job(const std::string& id, const Pose& from, const Pose& to,
                            const std::string& arm = "left", double duration_s = 3.0) {
    nlohmann::json body = move(arm, from, to, duration_s);
    body["id"] = id;
    return body;
  }
  static void expect_refused(const Answer& answer, int status, const std::string& pointer,
                             const nlohmann::json& value) {
    EXPECT_EQ(answer.status, status) << answer.body;
    EXPECT_EQ(answer.headers.at("content-type"), "application/problem+json");
    EXPECT_EQ(answer.json()["pointer"], pointer) << answer.body;
    EXPECT_EQ(answer.json()["value"], value) << answer.body;
  }
  std::size_t jobs_stored() { return get("/api/v1/jobs").json()["jobs"].size(); }
};

}  // namespace armloom::test
