#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "server/api/listings.h"
#include "test/server/verbs_fixture.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::kHome;

JobSheet::JobPtr job_of(std::uint64_t id, const std::string& key) {
  return std::make_shared<const JobView>(JobView{.id = JobId{id}, .key = key});
}

TEST(JobTexts, SerializesAJobOnlyWhenItChanged) {
  const WallClock clock(std::chrono::system_clock::now(), 1.0);
  JobTexts texts;
  const auto one = job_of(1, "one"), two = job_of(2, "two");
  const auto before = texts.of({one, two}, clock);
  texts.end_list();
  const auto after = texts.of({one, job_of(2, "other")}, clock);
  EXPECT_EQ(std::get<JobText>(before[0]), std::get<JobText>(after[0]));
  EXPECT_NE(std::get<JobText>(after[1])->find("\"other\""), std::string::npos);
}

class Reads : public test::VerbsFixture {
 protected:
  static bool holds(const json& list, const std::string& id) {
    return std::ranges::any_of(list, [&](const json& job) { return job["id"] == id; });
  }
};

TEST_F(Reads, ShowAllAcknowledgedCommands) {
  start(1.0);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  EXPECT_EQ(get("/api/v1/queue").json()["stopped"], true);
  for (int i = 0; i < 30; ++i) {
    const std::string id = "job-of-client-" + std::to_string(i);
    ASSERT_EQ(post("/api/v1/jobs", job(id, kHome, kHome).dump()).status, 202);
    const json queue = get("/api/v1/queue").json();
    EXPECT_TRUE(holds(queue["queued"], id) || holds(queue["backlog"], id)) << id;
    EXPECT_TRUE(holds(get("/api/v1/jobs").json()["jobs"], id)) << id;
    EXPECT_EQ(get("/api/v1/timeline").json()["arms"][0]["waiting"], i + 1);
    EXPECT_EQ(get("/api/v1/jobs/" + id).json()["id"], id);
  }
  ASSERT_EQ(remove("/api/v1/jobs/job-of-client-7").status, 202);
  EXPECT_EQ(get("/api/v1/jobs/job-of-client-7").json()["state"], "canceled");
  EXPECT_EQ(
      get("/api/v1/queue").json()["queued"].size() + get("/api/v1/queue").json()["backlog"].size(),
      29U);
}

TEST_F(Reads, SnapshotHasEveryQueuedJob) {
  start(1.0);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  for (const char* id : {"a", "b"}) {
    ASSERT_EQ(post("/api/v1/jobs", job(id, kHome, kHome).dump()).status, 202);
  }
  test::Listener listener(port());
  const json snapshot = listener.next_of("snapshot")["data"];
  EXPECT_TRUE(holds(snapshot["jobs"], "a"));
  EXPECT_TRUE(holds(snapshot["jobs"], "b"));
  EXPECT_EQ(snapshot["queue"]["stopped"], true);
  EXPECT_EQ(snapshot["arms"].size(), 2U);
}

}  // namespace
}  // namespace armloom
