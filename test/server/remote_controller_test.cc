// The server's end of the connection to a robot in another process, with the robot in a thread.
#include "server/drivers/remote_controller.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "core/arm/simulated_arm.h"
#include "core/model/cell/build_cell.h"
#include "core/trajectory/set_joints.h"
#include "server/arm_process/robot_host.h"
#include "server/codec/cell_codec.h"
#include "test/source_dir.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

CellPtr cell_with_endpoint(const std::string& endpoint) {
  const fs::path folder = fs::path(source_dir()) / "config";
  std::ifstream in(folder / "two_pandas_remote.json");
  std::stringstream text;
  text << in.rdbuf();
  CellDescription description = read_cell_text(text.str(), folder).value();
  description.robots[0].controller.endpoint = endpoint;
  // A busy machine is late.
  description.robots[0].controller.feedback_timeout = 5s;
  return build_cell(description).value();
}

class Remote : public ::testing::Test {
 protected:
  Remote() {
    std::vector<std::unique_ptr<ArmController>> arms;
    const Arm& arm = cell->arm(ArmId{0});
    std::vector<JointId> joints = arm.joints;
    joints.insert(joints.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
    arms.push_back(
        std::make_unique<SimulatedArm>(cell, ArmId{0}, joints_of(cell->home(), joints), 1));
    host = RobotHost::listen(cell, RobotId{0},
                             parse_endpoint(cell->robots[0].controller.endpoint).value(),
                             std::move(arms), [](const LogLine&) {})
               .value();
    process = std::thread([this] { host->run([this] { return ends.load(); }); });
  }
  ~Remote() override {
    ends = true;
    process.join();
    fs::remove_all(folder);
  }

  // Polls until `holds`, once per millisecond of cell time.
  template <class Holds>
  void poll_until(Holds holds) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (!holds(controller.poll(now += kControlPeriod))) {
      ASSERT_LT(std::chrono::steady_clock::now(), end);
      std::this_thread::sleep_for(1ms);
    }
  }

  fs::path folder = [] {
    std::string name = (fs::temp_directory_path() / "armloom-XXXXXX").string();
    return fs::path(mkdtemp(name.data()));
  }();
  CellPtr cell = cell_with_endpoint("unix:" + (folder / "arm.sock").string());
  std::atomic<bool> ends = false;
  std::unique_ptr<RobotHost> host;
  std::thread process;
  std::shared_ptr<RemoteRobot> robot = std::make_shared<RemoteRobot>(cell, RobotId{0}, "a session");
  RemoteController controller{robot, *cell, ArmId{0}};
  TimePoint now{};
};

TEST_F(Remote, ShowsAConnectionBeforeItsFirstReport) {
  EXPECT_FALSE(controller.connection().is_up);
  EXPECT_EQ(controller.connection().number, 0u);
  poll_until([&](const ArmFeedback* report) {
    EXPECT_EQ(report, nullptr) << "a report before the connection is up";
    return controller.connection().is_up;
  });
  EXPECT_EQ(controller.connection().number, 1u);
  poll_until([](const ArmFeedback* report) { return report != nullptr; });
}

TEST_F(Remote, NeverSendsACommandOverALaterConnection) {
  poll_until([](const ArmFeedback* report) { return report != nullptr; });
  controller.send({1, ArmCommand::Release{}});
  poll_until([](const ArmFeedback* report) { return report && report->acknowledged == 1; });
  robot->cut(50ms);
  poll_until([&](const ArmFeedback*) { return !controller.connection().is_up; });
  EXPECT_NE(controller.connection().detail, "");
  controller.send({2, ArmCommand::Release{}});
  robot->send(1, 0, {2, ArmCommand::Release{}});  // as if sent just before the cut was noticed
  poll_until([&](const ArmFeedback*) { return controller.connection().is_up; });
  EXPECT_EQ(controller.connection().number, 2u);
  for (int reports = 0; reports < 20;) {
    poll_until([&](const ArmFeedback* report) {
      if (report == nullptr) return false;
      EXPECT_EQ(report->acknowledged, 1u);
      ++reports;
      return true;
    });
  }
  controller.send({2, ArmCommand::Release{}});
  poll_until([](const ArmFeedback* report) { return report && report->acknowledged == 2; });
}

TEST(ArmMessages, KeepATrajectoryToTheLastBit) {
  const CellPtr cell = cell_with_endpoint("unix:/tmp/none");
  const std::vector<JointId> joints = cell->arm(ArmId{0}).joints;
  Segment segment{Duration{}, 1234567891ns, {}};
  segment.coefficients = Eigen::Matrix<double, Eigen::Dynamic, 6>::Random(7, 6) / 3.0;
  const ArmCommand::Follow follow{
      std::make_shared<const Trajectory>(joints, std::vector{ArmId{0}}, std::vector{segment}),
      TimePoint{}, 17ns, 123456789ns};
  const auto read = read_server_line(line_of(message_of({9, follow}, *cell, "left", Duration(-5))));
  ASSERT_TRUE(read) << read.error().front().detail;
  const auto& message = std::get<Numbered<FollowMessage>>(*read);
  EXPECT_EQ(message.number, 9u);
  EXPECT_EQ(message.what.start_at_ns, -5);
  EXPECT_EQ(message.what.authority_ns, 123456789);
  ASSERT_EQ(message.what.pieces.size(), 1u);
  EXPECT_EQ(message.what.pieces[0].duration_ns, 1234567891);
  for (Eigen::Index row = 0; row < 7; ++row) {
    for (Eigen::Index k = 0; k < 6; ++k) {
      EXPECT_EQ(message.what.pieces[0]
                    .coefficients[static_cast<std::size_t>(row)][static_cast<std::size_t>(k)],
                segment.coefficients(row, k));
    }
  }
}

TEST(LineStream, RefusesLinesAndQueuesBeyondTheirLimits) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends), 0);
  LineStream out(Descriptor(ends[0]), 100, 1000);
  LineStream in(Descriptor(ends[1]), 10, 1000);
  out.send("one");
  out.send("");
  out.send("exactly 10");
  out.send("more than 10");
  out.flush();
  in.receive();
  EXPECT_EQ(in.next_line(), "one");
  EXPECT_EQ(in.next_line(), "");
  EXPECT_EQ(in.next_line(), "exactly 10");
  EXPECT_FALSE(in.end());
  EXPECT_EQ(in.next_line(), std::nullopt);
  EXPECT_TRUE(in.end());
  out.send(std::string(2000, 'x'));
  EXPECT_TRUE(out.end()) << "more than the limit waits to be sent";
}

}  // namespace
}  // namespace armloom
