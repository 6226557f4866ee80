// Commands for a running server: jobs, why, stop, events.
#include "test/server/serve_fixture.h"
#include "test/server/wire.h"

namespace armloom {
namespace {

using nlohmann::json;

class RemoteCommand : public test::Serve {
 protected:
  [[nodiscard]] test::Outcome ask(std::uint16_t port, const std::string& arguments) const {
    setenv("ARMLOOM_URL", ("http://127.0.0.1:" + std::to_string(port)).c_str(), 1);
    return run(arguments);
  }
  void TearDown() override {
    unsetenv("ARMLOOM_URL");
    unsetenv("ARMLOOM_TOKEN");
  }
};

TEST_F(RemoteCommand, ShowsJobsAndStopsArms) {
  const test::ServeProcess server({"--cell", test::kCell}, log());
  const std::uint16_t port = server.port();
  begin_job(port, "reach", "left");
  EXPECT_NE(ask(port, "jobs").out.find("reach"), std::string::npos);
  EXPECT_EQ(json::parse(ask(port, "jobs --json --arm right").out)["jobs"], json::array());
  const auto one = ask(port, "stop left");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(test::request(port, "GET", "/api/v1/queue").json()["stopped"], false);
  const auto why = ask(port, "why reach");
  EXPECT_TRUE(why.out.starts_with("Job reach of arm left ")) << why.out;
  EXPECT_EQ(json::parse(ask(port, "why reach --json").out)["id"], "reach");
  const auto all = ask(port, "stop");
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_EQ(test::request(port, "GET", "/api/v1/queue").json()["stopped"], true);
  EXPECT_EQ(ask(port, "resume right left").exit_code, 0);
  EXPECT_EQ(test::request(port, "GET", "/api/v1/queue").json()["stopped"], false);
  EXPECT_EQ(ask(port, "cancel reach").exit_code, 0);
  const auto events = ask(port, "events --count 1");
  EXPECT_NE(events.out.find("snapshot  1 jobs, 2 arms"), std::string::npos) << events.out;
  EXPECT_EQ(json::parse(ask(port, "events --count 1 --json").out)["type"], "snapshot");
}

TEST_F(RemoteCommand, SetsAndPrintsTheSpeedOverride) {
  const test::ServeProcess server({"--cell", test::kCell}, log());
  const std::uint16_t port = server.port();
  EXPECT_EQ(ask(port, "speed 0.5").out, "speed override of the cell: 50 %\n");
  EXPECT_EQ(ask(port, "speed 0.25 left").out,
            "speed override of arm left: 25 %; the arm moves at 12.5 %\n");
  EXPECT_EQ(ask(port, "speed").out, "speed override of the cell: 50 %\n");
  EXPECT_EQ(json::parse(ask(port, "speed --arm right --json").out)["effective_speed_override"],
            0.5);
  const auto refused = ask(port, "speed 2");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("/speed_override: a speed override is 0, or from 0.001 to 1"),
            std::string::npos)
      << refused.err;
  for (const std::string typed : {"nan", "inf", "0,5", "left"}) {
    const auto outcome = ask(port, "speed " + typed);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find(typed + " is not a number"), std::string::npos) << outcome.err;
  }
}

TEST_F(RemoteCommand, ExitsWithTwoIfAnArmIsNotResumed) {
  const test::ServeProcess server({"--cell", test::kCell}, log());
  const std::uint16_t port = server.port();
  ASSERT_EQ(ask(port, "faults add left cut").exit_code, 0);
  const auto is_lost = [port] {
    return test::request(port, "GET", "/api/v1/arms/left").json()["link"] == "lost";
  };
  for (int i = 0; i < 10'000 && !is_lost(); ++i) {
  }
  for (const std::string arms : {"", " left", " right left"}) {
    const auto outcome = ask(port, "resume" + arms);
    EXPECT_EQ(outcome.exit_code, 2) << arms;
    EXPECT_NE(outcome.err.find("left"), std::string::npos) << outcome.err;
  }
  const auto all = ask(port, "resume --json");
  EXPECT_EQ(all.exit_code, 2);
  EXPECT_EQ(json::parse(all.out)["not_resumed"], json({"left"}));
  EXPECT_EQ(ask(port, "resume right").exit_code, 0);
}

TEST_F(RemoteCommand, AddsListsAndRemovesFaults) {
  const test::ServeProcess server({"--cell", test::kCell}, log());
  const std::uint16_t port = server.port();
  EXPECT_EQ(ask(port, "faults").out, "no faults\n");
  const auto added = ask(port, "faults add left drift --value -0.2 --at 1e5 --for 2 --json");
  ASSERT_EQ(added.exit_code, 0) << added.err;
  EXPECT_EQ(json::parse(added.out), json({{"id", "1"},
                                          {"arm", "left"},
                                          {"kind", "drift"},
                                          {"value", -0.2},
                                          {"at_s", 1e5},
                                          {"for_s", 2.0}}));
  EXPECT_NE(ask(port, "faults add right stall").out.find("2      right  stall  -  "),
            std::string::npos);
  const auto list = ask(port, "faults list --json");
  EXPECT_EQ(json::parse(list.out)["faults"].size(), 2U) << list.out << list.err;
  const auto text = ask(port, "faults").out;
  EXPECT_TRUE(text.starts_with("FAULT  ARM    KIND   VALUE  STARTS")) << text;
  const auto removed = ask(port, "faults remove 7 1 2");
  EXPECT_EQ(removed.exit_code, 2);
  EXPECT_EQ(removed.err, "armloom: no such fault \"7\"\n");
  EXPECT_EQ(ask(port, "faults").out, "no faults\n");
  const auto refused = ask(port, "faults add left slow");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(
      refused.err,
      "armloom: --value: \"value\" is missing: give the share of the speed, at least 0 and at "
      "most 1\n");
}

TEST_F(RemoteCommand, StopsTheOtherArmsIfOneIsUnknown) {
  const test::ServeProcess server({"--cell", test::kCell}, log());
  const auto outcome = ask(server.port(), "stop lfet left right");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "armloom: no such arm \"lfet\"; did you mean left?\n");
  EXPECT_EQ(test::request(server.port(), "GET", "/api/v1/queue").json()["stopped"], true);
}

TEST_F(RemoteCommand, StopsAlsoIfTheCategoryIsWrong) {
  const test::ServeProcess server({"--cell", test::kCell}, log());
  for (const std::string category : {"5", "''"}) {
    ASSERT_EQ(ask(server.port(), "resume").exit_code, 0);
    const auto outcome = ask(server.port(), "stop --category " + category);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("within 0..2"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("All arms were stopped with category 2"), std::string::npos);
    EXPECT_EQ(test::request(server.port(), "GET", "/api/v1/queue").json()["stopped"], true);
  }
}

TEST_F(RemoteCommand, ExplainsWhatIsWrong) {
  const auto unreached = ask(1, "jobs");
  EXPECT_EQ(unreached.exit_code, 69);
  EXPECT_NE(unreached.err.find("http://127.0.0.1:1 "), std::string::npos) << unreached.err;
  EXPECT_NE(unreached.err.find("ARMLOOM_URL"), std::string::npos) << unreached.err;
  EXPECT_EQ(run("why a --url ftp://x").exit_code, 2);
  const std::string tokens = (folder_ / "tokens").string();
  const auto added = run("token add --tokens " + tokens + " --name a --role viewer");
  ASSERT_EQ(added.exit_code, 0) << added.err;
  const std::string token = added.out.substr(added.out.find("armloom_"), 72);
  const test::ServeProcess server({"--cell", test::kCell, "--tokens", tokens}, log());
  const auto asks = ask(server.port(), "why nothing");
  EXPECT_EQ(asks.exit_code, 2);
  EXPECT_NE(asks.err.find("ARMLOOM_TOKEN"), std::string::npos) << asks.err;
  setenv("ARMLOOM_TOKEN", token.substr(0, token.find('\n')).c_str(), 1);
  EXPECT_EQ(ask(server.port(), "why nothing").err,
            "armloom: no such job \"nothing\"; GET /jobs lists them\n");
}

}  // namespace
}  // namespace armloom
