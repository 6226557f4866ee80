#include <sqlite3.h>

#include <algorithm>

#include "test/server/durable_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::FailingDisk;

class DamagedFolder : public Durable {
 protected:
  void damage(const char* statement) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open((data_ / "armloom.db").c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, statement, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }
  bool is_told(const std::string& what) {
    const json alerts = get("/api/v1/alerts").json()["alerts"];
    return std::ranges::any_of(alerts, [&](const json& alert) {
      return alert["level"] == "error" && alert["text"].get<std::string>().find(what) != what.npos;
    });
  }
};

TEST_F(DamagedFolder, SceneThatCannotBeRestoredKeepsArmsStopped) {
  on_restart_ = OnRestart::continue_;
  start(1);
  ASSERT_EQ(post("/api/v1/scene/objects",
                 R"({"name": "crate", "box": [0.1, 0.1, 0.1], "xyz": [2, 2, 2]})")
                .status,
            201);
  end();
  damage("UPDATE scene_object SET text = replace(text, '0.1,', '0.2,')");
  start(1);
  EXPECT_TRUE(get("/api/v1/queue").json()["stopped"]);
  EXPECT_TRUE(
      is_told("object \"crate\" cannot be restored: its record in the data folder is damaged"));
}

TEST_F(DamagedFolder, JobIsReportedAndNotStarted) {
  start(1);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  submit("sound");
  submit("damaged", "right");
  end();
  damage("UPDATE job SET view = '{\"id', arms = '[' WHERE id = 'damaged'");
  start(1);
  EXPECT_EQ(job("sound")["state"], "queued");
  const json damaged = job("damaged");
  EXPECT_EQ(damaged["state"], "interrupted");
  EXPECT_NE(damaged["result"]["detail"].get<std::string>().find("damaged"), std::string::npos);
  wait_until([&] { return is_told("\"damaged\""); });
}

TEST_F(DamagedFolder, UnknownStopsKeepAllArmsStoppedWithAnAlert) {
  start(1);
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  end();
  damage("UPDATE stopped_arm SET name = 'lefu'");
  start(1);
  wait_until([&] { return is_told("the list of stopped arms is damaged"); });
  EXPECT_EQ(state_of("left"), "stopped");
  EXPECT_EQ(state_of("right"), "stopped");
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  restart();
  EXPECT_EQ(state_of("left"), "idle");
  EXPECT_EQ(state_of("right"), "idle");
}

TEST_F(DamagedFolder, UnknownSpeedOverrideKeepsAllArmsStoppedWithAnAlert) {
  on_restart_ = OnRestart::continue_;
  start(1);
  ASSERT_EQ(put_speed("/speed", 0.2).status, 200);
  ASSERT_EQ(put_speed("/arms/left/speed", 0.5).status, 200);
  end();
  damage("UPDATE speed_override SET text = replace(text, '0.2', '0.9')");
  start(1);
  wait_until(
      [&] { return is_told("speed override of the cell cannot be restored: its record in the"); });
  EXPECT_EQ(state_of("left"), "stopped");
  EXPECT_EQ(state_of("right"), "stopped");
  EXPECT_EQ(speed_of("/arms/left"), 0.5);
  ASSERT_EQ(put_speed("/speed", 0.2).status, 200);
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  restart();
  EXPECT_EQ(speed_of("/speed"), 0.2);
  EXPECT_EQ(state_of("left"), "idle");
}

// An operator stops an arm while the disk is full, and restarts the server to fix the disk.
TEST_F(Durable, UnwrittenStopKeepsAllArmsStoppedAfterRestart) {
  on_restart_ = OnRestart::continue_;
  start(1);
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  EXPECT_EQ(submit("held").status, 202);
  ASSERT_EQ(post("/api/v1/arms/left/resume", "").status, 202);
  wait_for("held", "running");
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  EXPECT_EQ(submit("next").status, 202);
  FailingDisk::fail(FailingDisk::Fault::full, 0);
  ASSERT_EQ(post("/api/v1/arms/right/stop", "").status, 202);
  end();
  FailingDisk::reset();
  start(20);
  EXPECT_EQ(state_of("left"), "stopped");
  EXPECT_EQ(state_of("right"), "stopped");
  EXPECT_EQ(job("next")["state"], "queued");
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  wait_for("next", "succeeded");
  restart();
  EXPECT_EQ(state_of("right"), "idle");
}

TEST_F(DamagedFolder, LostCommitsStopAllArmsWithAnAlert) {
  on_restart_ = OnRestart::continue_;
  start(1);
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  EXPECT_EQ(submit("kept").status, 202);
  end();
  damage("UPDATE written SET commits = commits - 1");
  start(1);
  wait_until([&] { return is_told("it holds less than the previous session wrote"); });
  EXPECT_EQ(state_of("right"), "stopped");
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  end();
  std::filesystem::remove(data_ / "armloom.mark");
  start(1);
  wait_until([&] { return is_told("armloom.mark is missing"); });
  EXPECT_EQ(state_of("right"), "stopped");
}

}  // namespace
}  // namespace armloom
