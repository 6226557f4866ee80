#include "server/drivers/arm_messages.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/part_groups.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/codec/whole_format.h"

namespace armloom {

using namespace formats;

namespace {

FormatPtr<std::int64_t> nanoseconds() { return whole<std::int64_t>(); }
constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::infinity()};

FormatPtr<JointTerms> joint_terms_format() {
  return object<JointTerms>({
      required("name", &JointTerms::name, name(), ""),
      always("velocity", &JointTerms::velocity, number(kPositive)),
      always("acceleration", &JointTerms::acceleration, number(kPositive)),
      always("brake", &JointTerms::brake, number(kPositive)),
  });
}

FormatPtr<ArmTerms> arm_terms_format() {
  return object<ArmTerms>({
      required("name", &ArmTerms::name, name(), ""),
      always("joints", &ArmTerms::joints, list(joint_terms_format())),
  });
}

PartPtr<FollowMessage> follow_part() {
  using Follow = FollowMessage;
  const auto piece = object<Follow::Piece>({
      always("duration_ns", &Follow::Piece::duration_ns, nanoseconds()),
      always("coefficients", &Follow::Piece::coefficients, list(number_list())),
  });
  return parts<Follow>({
      always("start_at_ns", &Follow::start_at_ns, nullable(nanoseconds())),
      always("from_ns", &Follow::from_ns, nanoseconds()),
      always("authority_ns", &Follow::authority_ns, nanoseconds()),
      always("joints", &Follow::joints, list(joint_terms_format(), {.fewest = 1})),
      always("pieces", &Follow::pieces, list(piece, {.fewest = 1})),
  });
}

PartPtr<ExtendMessage> extend_part() {
  return always("authority_ns", &ExtendMessage::authority_ns, nanoseconds());
}
PartPtr<BrakeMessage> brake_part() {
  return always("category", &BrakeMessage::category, integer(0, 2));
}
PartPtr<ReleaseMessage> release_part() { return parts<ReleaseMessage>({}); }
PartPtr<SetSpeedMessage> set_speed_part() {
  return parts<SetSpeedMessage>({
      always("share", &SetSpeedMessage::share, number(kZeroToOne)),
      omit_default("brake", &SetSpeedMessage::brake, 1.0, number(PayloadDescription::brake_range),
                   ""),
  });
}

template <class What>
FormatPtr<Numbered<What>> numbered(const char* type, const PartPtr<What>& what) {
  using Message = Numbered<What>;
  return object<Message>({
      constant<Message>("type", type),
      required("arm", &Message::arm, name(), ""),
      always("number", &Message::number, whole()),
      inlined(&Message::what, what),
  });
}

FormatPtr<Hello> hello_format() {
  return object<Hello>({
      constant<Hello>("type", "hello"),
      always("protocol", &Hello::protocol, whole<int>()),
      required("session", &Hello::session, name(), ""),
      required("cell", &Hello::cell, name(), ""),
      required("robot", &Hello::robot, name(), ""),
      always("arms", &Hello::arms, list(arm_terms_format(), {.fewest = 1})),
      always("start_tolerance_rad", &Hello::start_tolerance_rad, number(kPositive)),
      always("reaction_s", &Hello::reaction_s, number(kNotNegative)),
      always("feedback_period_s", &Hello::feedback_period_s, number(kPositive)),
      always("timeout_s", &Hello::timeout_s, number(kPositive)),
  });
}

FormatPtr<Welcome> welcome_format() {
  const auto arm = object<Welcome::Arm>({
      required("name", &Welcome::Arm::name, name(), ""),
      always("joints", &Welcome::Arm::joints, list(name())),
  });
  return object<Welcome>({
      constant<Welcome>("type", "welcome"),
      always("protocol", &Welcome::protocol, whole<int>()),
      required("robot", &Welcome::robot, name(), ""),
      always("arms", &Welcome::arms, list(arm)),
      always("reaction_s", &Welcome::reaction_s, number(kNotNegative)),
      always("feedback_period_s", &Welcome::feedback_period_s, number(kPositive)),
  });
}

FormatPtr<HelloRefusal> refusal_format() {
  return object<HelloRefusal>({
      constant<HelloRefusal>("type", "error"),
      required("detail", &HelloRefusal::detail, text(), ""),
      field("pointer", &HelloRefusal::pointer, text(), ""),
  });
}

FormatPtr<Heartbeat> heartbeat_format() {
  return object<Heartbeat>({
      constant<Heartbeat>("type", "heartbeat"),
      always("time_ns", &Heartbeat::time_ns, nanoseconds()),
      field("controller_time_ns", &Heartbeat::controller_time_ns, nanoseconds(), ""),
  });
}

}  // namespace

FormatPtr<FeedbackMessage> feedback_format() {
  using Feedback = FeedbackMessage;
  return object<Feedback>({
      constant<Feedback>("type", "feedback"),
      required("arm", &Feedback::arm, name(), ""),
      always("sequence", &Feedback::sequence, whole()),
      always("time_ns", &Feedback::time_ns, nanoseconds()),
      always("acknowledged", &Feedback::acknowledged, whole()),
      always("rejected", &Feedback::rejected, whole()),
      always("phase", &Feedback::phase, choice<ArmFeedback::Phase>()),
      always("commanded_ns", &Feedback::commanded_ns, nanoseconds()),
      always("measured_ns", &Feedback::measured_ns, nanoseconds()),
      always("authority_ns", &Feedback::authority_ns, nanoseconds()),
      field("rests_at_ns", &Feedback::rests_at_ns, nanoseconds(), ""),
      always("positions", &Feedback::positions, number_list()),
      field("detail", &Feedback::detail, text(), ""),
      always("drives_on", &Feedback::drives_on, flag()),
      always("at_rest", &Feedback::at_rest, flag()),
  });
}

namespace {

// The messages of one side, in the order of its variant.
template <class... Messages>
struct Side {
  struct Line {
    std::string type;
    AnyFormatPtr format;
  };
  using Message = std::variant<Messages...>;
  using Read = void (*)(const AnyFormat&, const JsonNode&, Message&);

  template <class Kind>
  static void read_as(const AnyFormat& format, const JsonNode& node, Message& out) {
    format.read_any(node, &out.template emplace<Kind>());
  }

  [[nodiscard]] std::string line_of(const Message& message) const {
    JsonWriter out;
    std::visit([&](const auto& one) { lines[message.index()].format->write_any(out, &one); },
               message);
    return out.take();
  }

  [[nodiscard]] Result<Message> read(std::string_view text) const {
    constexpr std::array<Read, sizeof...(Messages)> kReads{read_as<Messages>...};
    const auto body = parse_json(text, JsonComments::refused);
    if (!body) return failure(body.error());
    Problems faults;
    Message message;
    const JsonNode node(*body, "", faults);
    if (node.is_object()) {
      node.required("type", [&](const JsonNode& type) {
        std::string name;
        if (!type.read(name)) return;
        const auto line = std::ranges::find(lines, name, &Line::type);
        if (line == lines.end()) {
          return type.invalid("unknown-type", "unknown message type \"" + name + "\"");
        }
        kReads[static_cast<std::size_t>(line - lines.begin())](*line->format, node, message);
      });
    }
    if (!faults.empty()) return failure(std::move(faults));
    return message;
  }

  std::vector<Line> lines;
};

template <class Variant>
struct SideOf;
template <class... Messages>
struct SideOf<std::variant<Messages...>> : Side<Messages...> {};

const SideOf<ServerMessage>& server_side() {
  static const SideOf<ServerMessage> side{{{
      {"hello", hello_format()->any()},
      {"heartbeat", heartbeat_format()->any()},
      {"follow", numbered("follow", follow_part())->any()},
      {"extend", numbered("extend", extend_part())->any()},
      {"brake", numbered("brake", brake_part())->any()},
      {"release", numbered("release", release_part())->any()},
      {"set_speed", numbered("set_speed", set_speed_part())->any()},
  }}};
  return side;
}
const SideOf<ControllerMessage>& controller_side() {
  static const SideOf<ControllerMessage> side{{{
      {"welcome", welcome_format()->any()},
      {"error", refusal_format()->any()},
      {"heartbeat", heartbeat_format()->any()},
      {"feedback", feedback_format()->any()},
  }}};
  return side;
}

}  // namespace

std::string line_of(const ServerMessage& message) { return server_side().line_of(message); }
std::string line_of(const ControllerMessage& message) { return controller_side().line_of(message); }
Result<ServerMessage> read_server_line(std::string_view line) { return server_side().read(line); }
Result<ControllerMessage> read_controller_line(std::string_view line) {
  return controller_side().read(line);
}

// ---- From and to the values of core ----

JointTerms terms_of(const Joint& joint) {
  return {joint.name, joint.velocity_max, joint.acceleration_max, joint.brake};
}

Hello hello_for(const Cell& cell, const Robot& robot, std::string session) {
  Hello hello;
  hello.session = std::move(session);
  hello.cell = cell.name;
  hello.robot = robot.name;
  for (const ArmId id : robot.arms) {
    const Arm& arm = cell.arm(id);
    ArmTerms terms{arm.name, {}};
    for (const JointId joint : arm.joints) terms.joints.push_back(terms_of(cell.joint(joint)));
    for (const JointId joint : arm.gripper_joints) {
      terms.joints.push_back(terms_of(cell.joint(joint)));
    }
    hello.arms.push_back(std::move(terms));
  }
  hello.start_tolerance_rad = cell.execution.start_tolerance_rad;
  hello.reaction_s = to_seconds(robot.controller.reaction);
  hello.feedback_period_s = to_seconds(robot.controller.feedback_period);
  hello.timeout_s = to_seconds(robot.controller.feedback_timeout);
  return hello;
}

namespace {

FollowMessage follow_message(const ArmCommand::Follow& follow, const Cell& cell,
                             std::optional<Duration> start_at) {
  FollowMessage message;
  if (start_at) message.start_at_ns = start_at->count();
  message.from_ns = follow.from.count();
  message.authority_ns = follow.authority.count();
  for (const JointId joint : follow.trajectory->joints()) {
    message.joints.push_back(terms_of(cell.joint(joint)));
  }
  for (const Segment& segment : follow.trajectory->segments()) {
    FollowMessage::Piece piece{segment.duration.count(), {}};
    for (Eigen::Index row = 0; row < segment.coefficients.rows(); ++row) {
      const Eigen::Matrix<double, 1, 6> of_joint = segment.coefficients.row(row);
      piece.coefficients.emplace_back(of_joint.data(), of_joint.data() + of_joint.size());
    }
    message.pieces.push_back(std::move(piece));
  }
  return message;
}

}  // namespace

ServerMessage message_of(const ArmCommand& command, const Cell& cell, const std::string& arm,
                         std::optional<Duration> start_at) {
  return std::visit(
      [&](const auto& what) -> ServerMessage {
        using What = std::decay_t<decltype(what)>;
        if constexpr (std::is_same_v<What, ArmCommand::Follow>) {
          return Numbered<FollowMessage>{arm, command.number, follow_message(what, cell, start_at)};
        } else if constexpr (std::is_same_v<What, ArmCommand::Extend>) {
          return Numbered<ExtendMessage>{arm, command.number, {what.authority.count()}};
        } else if constexpr (std::is_same_v<What, ArmCommand::Brake>) {
          return Numbered<BrakeMessage>{arm, command.number, {static_cast<int>(what.category)}};
        } else if constexpr (std::is_same_v<What, ArmCommand::SetSpeed>) {
          return Numbered<SetSpeedMessage>{arm, command.number, {what.share, what.brake}};
        } else {
          return Numbered<ReleaseMessage>{arm, command.number, {}};
        }
      },
      command.what);
}

FeedbackMessage message_of(const ArmFeedback& feedback, const std::string& arm) {
  FeedbackMessage message;
  message.arm = arm;
  message.sequence = feedback.sequence;
  message.time_ns = feedback.controller_time.count();
  message.acknowledged = feedback.acknowledged;
  message.rejected = feedback.rejected;
  message.phase = feedback.phase;
  message.commanded_ns = feedback.commanded_progress.count();
  message.measured_ns = feedback.measured_progress.count();
  message.authority_ns = feedback.authority.count();
  if (feedback.rests_at) message.rests_at_ns = feedback.rests_at->count();
  message.positions.assign(feedback.measured.data(),
                           feedback.measured.data() + feedback.measured.size());
  message.detail = feedback.detail;
  message.drives_on = feedback.drives_on;
  message.at_rest = feedback.at_rest;
  return message;
}

ArmFeedback feedback_of(const FeedbackMessage& message) {
  ArmFeedback feedback;
  feedback.sequence = message.sequence;
  feedback.controller_time = Duration(message.time_ns);
  feedback.acknowledged = message.acknowledged;
  feedback.rejected = message.rejected;
  feedback.phase = message.phase;
  feedback.commanded_progress = Duration(message.commanded_ns);
  feedback.measured_progress = Duration(message.measured_ns);
  feedback.authority = Duration(message.authority_ns);
  if (message.rests_at_ns) feedback.rests_at = Duration(*message.rests_at_ns);
  feedback.measured = Eigen::Map<const Eigen::VectorXd>(
      message.positions.data(), static_cast<Eigen::Index>(message.positions.size()));
  feedback.detail = message.detail;
  feedback.drives_on = message.drives_on;
  feedback.at_rest = message.at_rest;
  return feedback;
}

}  // namespace armloom
