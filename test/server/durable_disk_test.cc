#include "test/server/durable_server.h"

namespace armloom {
namespace {

using nlohmann::json;
using test::FailingDisk;

TEST_F(Durable, FullDiskRefusesJobsAndStopsArmsUntilItHasSpace) {
  start(1);
  submit("runs");
  wait_for("runs", "running");
  FailingDisk::fail(FailingDisk::Fault::full, 0);
  const auto refused = submit("refused", "right");
  EXPECT_EQ(refused.status, 507) << refused.body;
  EXPECT_EQ(refused.json()["type"], "urn:armloom:problem:storage-full");
  const auto ready = get("/readyz");
  EXPECT_EQ(ready.status, 503);
  EXPECT_EQ(ready.json()["type"], "urn:armloom:problem:storage-full") << "before all else";
  EXPECT_NE(get("/metrics").body.find("\narmloom_storage_failed 1\n"), std::string::npos);
  EXPECT_EQ(get("/healthz").status, 200);
  const json batch = {{"jobs", json::array({swing("refused-2", "right")})}};
  EXPECT_EQ(post("/api/v1/batches", batch.dump()).status, 507);
  wait_until([&] { return get("/api/v1/queue").json()["stopped"] == true; });
  EXPECT_EQ(post("/api/v1/resume", "").status, 503);
  EXPECT_EQ(post("/api/v1/arms/left/resume", "").status, 503);
  EXPECT_EQ(post("/api/v1/stop", "").status, 202);
  wait_until([&] { return get("/api/v1/arms/left").json()["state"] == "stopped"; });

  FailingDisk::fail(FailingDisk::Fault::none, 0);
  wait_until([&] { return get("/readyz").status == 200; });
  EXPECT_TRUE(get("/api/v1/queue").json()["stopped"]) << "until someone resumes";
  EXPECT_EQ(submit("again", "right").status, 202);
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  wait_for("runs", "succeeded");
  restart();
  EXPECT_EQ(job("runs")["state"], "succeeded");
  EXPECT_EQ(get("/api/v1/jobs/refused").status, 404) << "its client was told so";
}

TEST_F(Durable, UnwrittenJobIsForgottenAndItsIdIsFree) {
  start(1);
  FailingDisk::fail(FailingDisk::Fault::full, 0);
  ASSERT_EQ(submit("tried").status, 507);
  wait_until([&] { return get("/api/v1/jobs/tried").status == 404; });
  EXPECT_EQ(get("/api/v1/jobs").json()["jobs"], json::array());
  FailingDisk::fail(FailingDisk::Fault::none, 0);
  wait_until([&] { return get("/readyz").status == 200; });
  EXPECT_EQ(get("/api/v1/jobs").json()["jobs"], json::array()) << "nor is it put down later";
  ASSERT_EQ(submit("tried").status, 202);
  ASSERT_EQ(post("/api/v1/resume", "").status, 202);
  wait_for("tried", "succeeded");
  restart();
  EXPECT_EQ(job("tried")["state"], "succeeded");
}

TEST_F(Durable, CancelDuringAFullDiskIsReportedAsNotStored) {
  start(1);
  ASSERT_EQ(post("/api/v1/stop", "").status, 202);
  ASSERT_EQ(submit("waits").status, 202);
  FailingDisk::fail(FailingDisk::Fault::full, 0);
  const auto canceled = remove("/api/v1/jobs/waits");
  EXPECT_EQ(canceled.status, 507) << canceled.body;
  EXPECT_NE(canceled.body.find("done, but not stored"), std::string::npos);
  EXPECT_EQ(job("waits")["state"], "canceled") << "it is done all the same";
}

TEST_F(Durable, AcknowledgementDuringAFullDiskIsReportedAsNotStored) {
  start(1);
  ASSERT_EQ(post("/api/v1/arms/left/stop", "").status, 202);
  const std::string id = get("/api/v1/alerts").json()["alerts"][0]["id"];
  FailingDisk::fail(FailingDisk::Fault::full, 0);
  const nlohmann::json seen = {{"ids", {id}}, {"who", "Ada"}};
  const auto warned = post("/api/v1/alerts/acknowledge", seen.dump());
  EXPECT_EQ(warned.status, 507);
  EXPECT_NE(warned.body.find("done, but not stored"), std::string::npos) << warned.body;
}

TEST_F(Durable, BrokenDiskIsReportedUnlikeAFullDisk) {
  start(1);
  FailingDisk::fail(FailingDisk::Fault::broken, 0);
  const auto refused = submit("refused");
  EXPECT_EQ(refused.status, 503) << refused.body;
  EXPECT_EQ(refused.json()["type"], "urn:armloom:problem:storage-failed");
}

}  // namespace
}  // namespace armloom
