#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/model/cell.h"
#include "core/model/endpoint.h"
#include "server/drivers/arm_messages.h"
#include "server/drivers/line_stream.h"

namespace armloom {

// The connection to the process that controls one robot (PROTOCOL.md). A thread of its own connects
// and reconnects until it succeeds. The public functions are thread-safe and never block.
class RemoteRobot {
 public:
  using Wall = std::chrono::steady_clock;
  using Event = std::variant<ArmConnection, ArmFeedback>;

  // `session`: see Hello. Precondition: the robot's endpoint is valid.
  RemoteRobot(CellPtr cell, RobotId robot, std::string session);
  ~RemoteRobot();

  // Sends a command over this connection. Drops the command if the connection has ended.
  void send(std::uint64_t connection, std::size_t arm, const ArmCommand& command);
  // Returns the arm's next event. A change of the connection precedes the reports of the new one.
  [[nodiscard]] std::optional<Event> next(std::size_t arm);
  // Tells that the server's control cycle runs, and the cell time of now. Heartbeats need it: if
  // the cycle hangs, the controller brakes.
  void cycle(TimePoint now);
  // Ends the connection, for tests. It is made again after `pause`.
  void cut(std::chrono::milliseconds pause);

 private:
  struct Outgoing {
    std::uint64_t connection;
    std::size_t arm;
    ArmCommand command;
  };
  struct ClockSample {
    Wall::duration round_trip;
    Duration offset;  // the controller's clock minus Wall
  };

  void run(std::stop_token stop);
  std::string converse(const std::stop_token& stop);
  void say_hello(LineStream& stream);
  std::optional<std::string> hear(const std::string& line, std::size_t& welcomed);
  std::optional<std::string> fault_of(const Welcome& welcome) const;
  std::optional<std::string> take(const FeedbackMessage& feedback);
  void measure_clock(const Heartbeat& heartbeat);
  void send_waiting(LineStream& stream);
  void publish_up();
  void publish_down(std::string why);
  void push(std::size_t arm, Event event);
  void wake();

  CellPtr cell_;
  const Robot& robot_;
  Endpoint endpoint_;
  std::string session_;
  Descriptor wakes_;  // eventfd

  std::atomic<std::int64_t> wall_to_cell_ns_{0};
  std::atomic<std::int64_t> beat_at_ns_{0};  // Wall; when the last heartbeat was asked for
  std::atomic<bool> beats_{false};           // a heartbeat is to be sent
  std::atomic<std::int64_t> cut_ms_{-1};     // asked for by cut()

  std::mutex mutex_;
  std::vector<std::deque<Event>> inboxes_;  // by arm
  std::deque<Outgoing> outbox_;
  bool overflowed_ = false;

  // Used by the thread only:
  std::uint64_t connection_ = 0;
  bool is_up_ = false;
  bool is_welcome_ = false;
  bool is_in_use_ = false;  // refused, because the controller serves another server
  std::string why_down_;
  std::deque<ClockSample> clock_;
  std::jthread thread_;  // the last: it ends first
};

}  // namespace armloom
