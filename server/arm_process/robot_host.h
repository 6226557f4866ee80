#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/cell.h"
#include "core/model/endpoint.h"
#include "server/arm_process/hosted_arm.h"
#include "server/drivers/line_stream.h"
#include "server/log/log_line.h"

namespace armloom {

// The process of one robot: runs the controllers of its arms in real time, and obeys one server at
// a time (PROTOCOL.md). Single-threaded.
class RobotHost {
 public:
  // `controllers`: one for each arm of the robot. Problems: cannot listen.
  [[nodiscard]] static Result<std::unique_ptr<RobotHost>> listen(
      CellPtr cell, RobotId robot, const Endpoint& endpoint,
      std::vector<std::unique_ptr<ArmController>> controllers, Log log);
  ~RobotHost();

  // The address at which servers connect.
  [[nodiscard]] const Endpoint& endpoint() const { return endpoint_; }
  // Runs until `ends` returns true; then brakes all arms and returns when they rest.
  void run(const std::function<bool()>& ends);

 private:
  using Wall = std::chrono::steady_clock;
  struct Peer {
    LineStream stream;
    Wall::time_point since;
  };

  RobotHost(CellPtr cell, RobotId robot, Endpoint endpoint, Descriptor listening, Log log);

  void cycle(Wall::time_point due);
  void wait(Wall::time_point due);
  void watch_server();
  void greet();
  [[nodiscard]] bool greet(Peer& peer);
  void answer(Peer peer, const Hello& hello);
  [[nodiscard]] std::optional<HelloRefusal> objection(const Hello& hello) const;
  void listen_to_server();
  void obey(const ServerMessage& message);
  void lose_server(std::string why);
  void brake_all();
  [[nodiscard]] HostedArm* find(const std::string& arm);
  [[nodiscard]] Duration clock() const;

  CellPtr cell_;
  const Robot& robot_;
  Endpoint endpoint_;
  Descriptor listening_;
  Log log_;
  std::vector<HostedArm> arms_;
  Wall::time_point began_ = Wall::now();
  TimePoint simulated_{};  // time of the last cycle, which lags behind clock() by slip_
  Duration slip_{};

  std::vector<Peer> strangers_;  // have not said hello yet
  std::optional<LineStream> server_;
  std::string session_;  // of the last server
  Wall::duration timeout_{};
  Wall::time_point heard_at_{};
  bool is_silent_ = false;  // no line for timeout_: the arms were braked
};

}  // namespace armloom
