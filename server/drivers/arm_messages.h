#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/base/problem.h"
#include "core/model/cell.h"
#include "server/codec/format.h"

namespace armloom {

// Messages between the server and the process that controls one robot, as described in PROTOCOL.md.
// Each message is a line of JSON.
inline constexpr int kArmProtocol = 1;
inline constexpr std::size_t kLineMax = std::size_t{32} << 20;  // bytes

// A joint with the limits that its controller keeps; rad, s (m, s).
struct JointTerms {
  std::string name;
  double velocity = 0.0;
  double acceleration = 0.0;
  double brake = 0.0;
};
struct ArmTerms {
  std::string name;
  std::vector<JointTerms> joints;  // arm joints, then gripper joints
};

// The server's first message.
struct Hello {
  int protocol = kArmProtocol;
  std::string session;  // the same for all connections of one run of the server
  std::string cell;
  std::string robot;
  std::vector<ArmTerms> arms;
  double start_tolerance_rad = 0.0;
  // Promises that the server relies on (ControllerDescription).
  double reaction_s = 0.0;
  double feedback_period_s = 0.0;
  double timeout_s = 0.0;  // without a line from the server, the controller brakes all arms
};
// The controller's first message, unless it is a HelloRefusal.
struct Welcome {
  struct Arm {
    std::string name;
    std::vector<std::string> joints;
  };
  int protocol = 0;
  std::string robot;
  std::vector<Arm> arms;
  double reaction_s = 0.0;
  double feedback_period_s = 0.0;
};
// The controller refuses the connection.
struct HelloRefusal {
  std::string detail;
  std::string pointer = {};  // into the hello
};
// Sent by the server; the controller sends it back with its own time.
struct Heartbeat {
  std::int64_t time_ns = 0;                             // on the server's clock
  std::optional<std::int64_t> controller_time_ns = {};  // on the controller's clock
};

struct FollowMessage {
  struct Piece {
    std::int64_t duration_ns = 0;
    std::vector<std::vector<double>> coefficients;  // per joint: of t^0 to t^5, t in s
  };
  std::optional<std::int64_t> start_at_ns;  // on the controller's clock; nullopt: at once
  std::int64_t from_ns = 0;
  std::int64_t authority_ns = 0;
  std::vector<JointTerms> joints;  // of all arms that move in step
  std::vector<Piece> pieces;
};
struct ExtendMessage {
  std::int64_t authority_ns = 0;
};
struct BrakeMessage {
  int category = 2;
};
struct ReleaseMessage {};
struct SetSpeedMessage {
  double share = 1.0;
  double brake = 1.0;
};
// A command to one arm.
template <class What>
struct Numbered {
  std::string arm;
  CommandNumber number = 0;
  What what = {};
};

struct FeedbackMessage {
  std::string arm;
  std::uint64_t sequence = 0;
  std::int64_t time_ns = 0;
  CommandNumber acknowledged = 0;
  CommandNumber rejected = 0;
  ArmFeedback::Phase phase = ArmFeedback::Phase::idle;
  std::int64_t commanded_ns = 0;
  std::int64_t measured_ns = 0;
  std::int64_t authority_ns = 0;
  std::optional<std::int64_t> rests_at_ns = {};
  std::vector<double> positions;
  std::string detail = {};
  bool drives_on = true;
  bool at_rest = false;
};

using ServerMessage =
    std::variant<Hello, Heartbeat, Numbered<FollowMessage>, Numbered<ExtendMessage>,
                 Numbered<BrakeMessage>, Numbered<ReleaseMessage>, Numbered<SetSpeedMessage>>;
using ControllerMessage = std::variant<Welcome, HelloRefusal, Heartbeat, FeedbackMessage>;

// Return the message as one line, without the line's end.
[[nodiscard]] std::string line_of(const ServerMessage& message);
[[nodiscard]] std::string line_of(const ControllerMessage& message);
// Problems: the pointers lead into the line.
[[nodiscard]] Result<ServerMessage> read_server_line(std::string_view line);
[[nodiscard]] Result<ControllerMessage> read_controller_line(std::string_view line);

// Describes a FeedbackMessage, with "type".
[[nodiscard]] FormatPtr<FeedbackMessage> feedback_format();

[[nodiscard]] JointTerms terms_of(const Joint& joint);
// Returns the hello for a robot of the cell.
[[nodiscard]] Hello hello_for(const Cell& cell, const Robot& robot, std::string session);
// Returns the command as a message, with `start_at` (nullopt: at once) on the controller's clock.
[[nodiscard]] ServerMessage message_of(const ArmCommand& command, const Cell& cell,
                                       const std::string& arm, std::optional<Duration> start_at);
[[nodiscard]] FeedbackMessage message_of(const ArmFeedback& feedback, const std::string& arm);
[[nodiscard]] ArmFeedback feedback_of(const FeedbackMessage& message);

}  // namespace armloom
