#include "server/control/control.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "core/executive/simulation.h"
#include "test/server/panda_jobs.h"
#include "test/server/running_server.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

class Jogging : public test::RunningServer {
 protected:
  // A long lease, because a busy machine may renew late.
  Jogging() { options_.jog_lease = 2s; }
  std::string take(const std::string& who, bool from_another = false) {
    const auto taken = post("/api/v1/control", json{{"who", who}, {"take", from_another}}.dump());
    EXPECT_EQ(taken.status, 200) << taken.body;
    return taken.json()["key"];
  }
  test::Answer jog(const std::string& key, const std::string& arm = "left",
                   const json& to = {{"joints", test::kMiddle}}) {
    return post("/api/v1/arms/" + arm + "/jog",
                json{{"control", key}, {"to", to}, {"velocity_scaling_factor", 0.05}}.dump());
  }
  test::Answer renew(const std::string& key, const std::string& arm = "left") {
    return put("/api/v1/arms/" + arm + "/jog", json{{"control", key}}.dump());
  }
  json arm(const std::string& name) { return get("/api/v1/arms/" + name).json(); }
  // Renews the lease until `is` returns true for the job.
  template <class Is>
  json renew_until(const std::string& key, Is is) {
    for (;;) {
      const auto renewed = renew(key);
      if (renewed.status != 200) throw std::runtime_error(renewed.body);
      const json job = renewed.json()["job"];
      if (is(job)) return job;
      std::this_thread::sleep_for(50ms);
    }
  }
  json ended(const std::string& id) {
    for (;;) {
      json job = get("/api/v1/jobs/" + id).json();
      if (!job["result"].is_null()) return job;
      std::this_thread::sleep_for(10ms);
    }
  }
};

TEST_F(Jogging, StopsOnThePathWhenTheLeaseExpires) {
  start(1.0);
  const std::string key = take("Ada");
  const auto begun = jog(key);
  ASSERT_EQ(begun.status, 202) << begun.body;
  const std::string id = begun.json()["job"]["id"];
  EXPECT_EQ(begun.json()["lease_s"], 2.0);
  EXPECT_EQ(get("/api/v1/control").json()["holder"]["arm"], "left");
  EXPECT_EQ(get("/api/v1/control").json()["holder"]["job"], id);
  renew_until(key, [](const json& job) { return job["progress"] > 0.0; });
  // Without renewals the lease expires after two seconds, and the job is canceled.
  const json last = ended(id);
  EXPECT_EQ(last["state"], "canceled");
  EXPECT_GT(last["progress"].get<double>(), 0.0);
  EXPECT_LT(last["progress"].get<double>(), 1.0);
  EXPECT_EQ(arm("left")["state"], "idle") << "it stands on its path, at rest";
  EXPECT_EQ(renew(key).status, 409) << "what has ended cannot be held";
}

TEST_F(Jogging, ReachesTheGoalIfRenewedAllTheWay) {
  start(20.0);
  const std::string key = take("Ada");
  // 20 s of cell time are 1 s of wall time; the lease counts wall time.
  const std::string id = jog(key, "left", {{"named", "ready"}}).json()["job"]["id"];
  for (;;) {
    const auto renewed = renew(key);
    if (renewed.status != 200) break;
    std::this_thread::sleep_for(20ms);
  }
  EXPECT_EQ(ended(id)["state"], "succeeded");
}

TEST_F(Jogging, IsForTheHolderOfControlOnly) {
  start(1.0);
  EXPECT_TRUE(get("/api/v1/control").json()["holder"].is_null());
  EXPECT_EQ(jog("nobody").status, 409);
  const std::string ada = take("Ada");
  EXPECT_EQ(get("/api/v1/control").json()["holder"]["who"], "Ada");
  EXPECT_EQ(get("/api/v1/control").body.find(ada), std::string::npos) << "the key is secret";
  const auto second = post("/api/v1/control", R"({"who": "Bob"})");
  EXPECT_EQ(second.status, 409);
  EXPECT_EQ(second.json()["value"], "Ada");
  const std::string id = jog(ada).json()["job"]["id"];
  renew_until(ada, [](const json& job) { return job["progress"] > 0.0; });
  const auto foreign = renew("0000");
  EXPECT_EQ(foreign.status, 409);
  EXPECT_EQ(foreign.json()["type"], "urn:armloom:problem:not-in-control");
  EXPECT_EQ(put("/api/v1/arms/right/jog", json{{"control", ada}}.dump()).status, 409);

  // Another client takes control: the jog motion stops at once, and its renewals are refused.
  const std::string bob = take("Bob", true);
  EXPECT_EQ(renew(ada).status, 409);
  EXPECT_EQ(ended(id)["state"], "canceled");
  EXPECT_EQ(post("/api/v1/control/release", json{{"control", ada}}.dump()).status, 409);
  EXPECT_EQ(post("/api/v1/control/release", json{{"control", bob}}.dump()).status, 200);
  EXPECT_TRUE(get("/api/v1/control").json()["holder"].is_null());
}

TEST_F(Jogging, ReportsBadGoalsAndExcessiveSpeed) {
  start(1.0);
  const std::string key = take("Ada");
  const auto nowhere = jog(key, "left", {{"named", "nowhere"}});
  EXPECT_EQ(nowhere.status, 422);
  EXPECT_EQ(nowhere.json()["pointer"], "/to/named") << nowhere.body;
  EXPECT_EQ(jog(key, "third").status, 404);
  const auto fast =
      post("/api/v1/arms/left/jog",
           json{{"control", key}, {"to", {{"named", "ready"}}}, {"velocity_scaling_factor", 0.5}}
               .dump());
  EXPECT_EQ(fast.status, 422);
  EXPECT_EQ(fast.json()["pointer"], "/velocity_scaling_factor");
}

TEST_F(Jogging, ExpiresWhileWaitingForAnotherArm) {
  start(1.0);
  test::Listener listener(port());
  json other = test::move("right", test::kHome, test::kMiddle, 20.0);
  other["id"] = "other";
  ASSERT_EQ(post("/api/v1/jobs", other.dump()).status, 202);
  until(listener, "other", "running");
  const std::string key = take("Ada");
  const std::string id = jog(key).json()["job"]["id"];
  renew_until(key, [](const json& job) { return job["state"] == "backlogged"; });
  const json last = ended(id);
  EXPECT_EQ(last["state"], "canceled");
  EXPECT_EQ(last["progress"], 0.0);
  EXPECT_EQ(get("/api/v1/jobs/other").json()["state"], "running") << "nobody else is disturbed";
}

TEST_F(Jogging, IsNotRestoredAfterARestart) {
  const auto data = std::filesystem::path(::testing::TempDir()) / "armloom-by-hand";
  std::filesystem::remove_all(data);
  options_.data = data;
  start(1.0);
  const std::string key = take("Ada");
  post("/api/v1/arms/left/stop", "");
  const std::string id = jog(key).json()["job"]["id"];
  test::Listener listener(port());
  end();
  start(1.0);
  const json job = get("/api/v1/jobs/" + id).json();
  EXPECT_EQ(job["state"].is_string() ? job["state"] : json("unknown"), "interrupted") << job;
}

// The lease counts wall time, because cell time stands still while the server is suspended.
TEST(Control, RefusesALateRenewal) {
  Control control;
  const Control::Time begun{};
  ASSERT_TRUE(control.take("Ada", false));
  control.begin({"left", "job-1", begun});
  EXPECT_TRUE(control.renew(500ms, begun + 500ms));
  EXPECT_TRUE(control.renew(500ms, begun + 1000ms));
  EXPECT_FALSE(control.renew(500ms, begun + 1501ms));
  EXPECT_FALSE(control.renew(500ms, begun + 1502ms)) << "it stays over";
}

// ---- Lease in the control cycle, without a server ----

class Watching final : public Observer {
 public:
  void on_event(const Event&) override {}
  void on_tick(TimePoint, const Configuration&) override {}
  void on_state(const StateFrame& frame) override {
    for (const ArmAuthority& motion : frame.motions)
      furthest = std::max(furthest, motion.authority);
  }
  Duration furthest{};  // largest authority of any arm
};

TEST(HoldToRun, ExpiredLeaseStopsTheArmWithinItsAuthority) {
  const auto file = std::filesystem::path(source_dir()) / "config/two_pandas.json";
  const auto text = read_text_file(file);
  const auto cell = build_cell(*read_cell_text(*text, file.parent_path())).value();
  Watching watching;
  auto simulation = Simulation::create(cell, {}, watching).value();
  Executive& executive = simulation->executive();
  simulation->run_until(at(100ms));
  JobRequest request;
  request.key = "by-hand";
  request.arm = "left";
  request.move_to = PlanGoal{};
  request.move_to->joints = std::vector<double>(test::kMiddle.begin(), test::kMiddle.end());
  request.speed = 0.1;
  const auto accepted = executive.submit(request);
  ASSERT_TRUE(accepted) << accepted.error().front().detail;
  ASSERT_FALSE(executive.cancel("nobody", at(1s)));
  TimePoint until = at(100ms);
  while (executive.job("by-hand")->motion.progress < 0.2) {
    until = simulation->now() + 500ms;
    ASSERT_TRUE(executive.cancel("by-hand", until));
    simulation->run_until(simulation->now() + 100ms);
    ASSERT_LT(simulation->now(), at(60s));
  }
  simulation->run_until(until - kControlPeriod);
  EXPECT_FALSE(executive.job("by-hand")->motion.stopping) << "the lease lasts to its last cycle";
  EXPECT_FALSE(is_terminal(executive.job("by-hand")->state));
  const Duration allowed = watching.furthest;
  simulation->run_until(until);
  EXPECT_TRUE(executive.job("by-hand")->motion.stopping)
      << "given up in the cycle in which it is over";
  simulation->run_until(until + 1s);
  const JobView over = *executive.job("by-hand");
  EXPECT_EQ(over.state, JobState::canceled);
  EXPECT_EQ(executive.arms()[0].state, ArmState::idle);
  EXPECT_LE(watching.furthest, allowed + 100ms) << "no more was granted than it needs to brake";
  EXPECT_GT(executive.figures().min_clearance_m, 0.02);
}

}  // namespace
}  // namespace armloom
