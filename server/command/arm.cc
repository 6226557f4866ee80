#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "core/arm/simulated_arm.h"
#include "core/trajectory/set_joints.h"
#include "server/arm_process/physics_robot.h"
#include "server/arm_process/robot_host.h"
#include "server/codec/stream_id.h"
#include "server/command/command.h"
#include "server/http/http_server.h"
#include "server/log/log_line.h"

namespace armloom {
namespace {

volatile std::sig_atomic_t signaled = 0;

// Returns the controllers of the robot's arms, each at home.
std::vector<std::unique_ptr<ArmController>> controllers_of(const CellPtr& cell, const Robot& robot,
                                                           std::uint64_t seed) {
  std::vector<std::unique_ptr<ArmController>> controllers;
  for (const ArmId id : robot.arms) {
    const Arm& arm = cell->arm(id);
    std::vector<JointId> joints = arm.joints;
    joints.insert(joints.end(), arm.gripper_joints.begin(), arm.gripper_joints.end());
    controllers.push_back(std::make_unique<SimulatedArm>(cell, id, joints_of(cell->home(), joints),
                                                         seed + id.index()));
  }
  return controllers;
}

void warn_of_access(const Endpoint& endpoint) {
  if (endpoint.is_unix() || reach_of(endpoint.host) != AddressReach::others) return;
  std::cerr << "armloom: warning: hazard: everybody who can reach " << endpoint.text()
            << " can move the arms: the protocol has no access control. Use a separate network, or "
               "listen on 127.0.0.1 behind a tunnel\n";
}

int refuse_option(const char* option, Problem problem) {
  problem.pointer = option;
  complain("", {std::move(problem)});
  return kExitBadInput;
}

// Parses "panda_hand=3.5"; nullopt if empty.
Result<std::optional<Payload>> payload_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t equals = text.rfind('=');
  Payload payload{.link = text.substr(0, equals)};
  const char* end = text.data() + text.size();
  if (equals != text.npos) {
    const auto [stop, ec] = std::from_chars(text.data() + equals + 1, end, payload.mass_kg);
    if (ec == std::errc{} && stop == end && payload.mass_kg > 0.0) return payload;
  }
  return failure(Problem{ProblemKind::invalid, "bad-payload", "",
                         "expected LINK=KG with a positive mass, for example left_panda_hand=3",
                         text});
}

Log log_to_stderr() {
  const auto logger = spdlog::stderr_color_mt("arm");
  return [logger](const LogLine& line) {
    logger->log(line.level == LogLine::Level::info ? spdlog::level::info : spdlog::level::warn,
                "{}", text_of(line));
  };
}

}  // namespace

int run_arm(const ArmOptions& options) {
  const auto loaded = load_cell(options.cell_file);
  if (!loaded) return kExitBadInput;
  const CellPtr& cell = loaded->cell;
  const auto robot = std::ranges::find(cell->robots, options.robot, &Robot::name);
  if (robot == cell->robots.end()) {
    std::string known;
    for (const Robot& one : cell->robots) known += (known.empty() ? "" : ", ") + one.name;
    return refuse_option("--robot",
                         {ProblemKind::invalid, "unknown-robot", "",
                          "the cell has no such robot; it has: " + known, options.robot});
  }
  if (robot->controller.type != "remote") {
    return refuse_option(
        "--robot", {ProblemKind::invalid, "simulated-robot", "",
                    "the server simulates this robot itself and never connects to a process: set "
                    "its controller in the cell file to {\"type\": \"remote\", \"endpoint\": "
                    "\"unix:PATH\"}",
                    options.robot});
  }
  if (options.hello) {
    std::cout << line_of(ServerMessage(hello_for(*cell, *robot, random_stream()))) << std::endl;
    return kExitDone;
  }
  const auto endpoint = parse_endpoint(options.listen);
  if (!endpoint) return refuse_option("--listen", endpoint.error().front());
  const RobotId id{static_cast<std::uint32_t>(robot - cell->robots.begin())};
  const Log log = log_to_stderr();
  std::vector<std::unique_ptr<ArmController>> controllers;
  if (options.physics) {
    const auto payload = payload_of(options.payload);
    if (!payload) return refuse_option("--payload", payload.error().front());
    const auto simulated = PhysicsRobot::create(cell, id, *payload, log);
    if (!simulated) {
      const Problem& first = simulated.error().front();
      return first.pointer == "payload" ? refuse_option("--payload", first)
                                        : refuse(options.cell_file, simulated.error());
    }
    controllers = PhysicsRobot::controllers(*simulated);
  } else {
    controllers = controllers_of(cell, *robot, options.seed);
  }
  auto host = RobotHost::listen(cell, id, *endpoint, std::move(controllers), log);
  if (!host) return refuse_option("--listen", host.error().front());
  warn_of_access((*host)->endpoint());
  const auto end = [](int) { signaled = 1; };
  std::signal(SIGINT, end);
  std::signal(SIGTERM, end);
  std::cout << "robot " << robot->name << " listens on " << (*host)->endpoint().text() << std::endl;
  (*host)->run([] { return signaled != 0; });
  return kExitDone;
}

}  // namespace armloom
