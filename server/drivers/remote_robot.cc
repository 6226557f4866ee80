#include "server/drivers/remote_robot.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/diagnostics.h"

namespace armloom {
namespace {

using Wall = RemoteRobot::Wall;
using std::chrono::milliseconds;

constexpr milliseconds kFirstPause{20};  // before the next attempt to connect; doubled each time
constexpr milliseconds kLongestPause{1000};
constexpr milliseconds kWelcomeWait{2000};
constexpr milliseconds kSilenceMin{1000};
constexpr int kTimeoutsOfSilence = 3;
// A timeout contains so many heartbeats.
constexpr int kBeatsPerTimeout = 5;
constexpr std::size_t kInboxMax = 1024;
constexpr std::size_t kOutboxMax = 4096;
constexpr std::size_t kUnsentMax = std::size_t{64} << 20;
constexpr std::size_t kClockSamples = 16;

// The robot's first problem as a phrase: place and text.
std::string phrase(const Problems& problems) {
  const Problem& first = problems.front();
  return (first.pointer.empty() ? "" : first.pointer + ": ") + first.detail;
}

std::int64_t wall_ns() { return Wall::now().time_since_epoch() / std::chrono::nanoseconds(1); }

}  // namespace

RemoteRobot::RemoteRobot(CellPtr cell, RobotId robot, std::string session)
    : cell_(std::move(cell)),
      robot_(cell_->robots[robot.index()]),
      endpoint_(parse_endpoint(robot_.controller.endpoint).value()),
      session_(std::move(session)),
      wakes_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      inboxes_(robot_.arms.size()),
      thread_([this](std::stop_token stop) { run(std::move(stop)); }) {}

RemoteRobot::~RemoteRobot() {
  thread_.request_stop();
  wake();
}

// ---- Called by the strand ----

void RemoteRobot::wake() {
  const std::uint64_t one = 1;
  (void)!write(wakes_.get(), &one, sizeof one);
}

void RemoteRobot::send(std::uint64_t connection, std::size_t arm, const ArmCommand& command) {
  {
    const std::scoped_lock lock(mutex_);
    if (outbox_.size() < kOutboxMax) {
      outbox_.push_back({connection, arm, command});
    } else {
      overflowed_ = true;
    }
  }
  wake();
}

std::optional<RemoteRobot::Event> RemoteRobot::next(std::size_t arm) {
  const std::scoped_lock lock(mutex_);
  std::deque<Event>& inbox = inboxes_[arm];
  if (inbox.empty()) return std::nullopt;
  Event event = std::move(inbox.front());
  inbox.pop_front();
  return event;
}

void RemoteRobot::cycle(TimePoint now) {
  const std::int64_t wall = wall_ns();
  wall_to_cell_ns_ = now.time_since_epoch().count() - wall;
  if (wall - beat_at_ns_ < robot_.controller.feedback_timeout.count() / kBeatsPerTimeout) return;
  beat_at_ns_ = wall;
  beats_ = true;
  wake();
}

void RemoteRobot::cut(std::chrono::milliseconds pause) {
  cut_ms_ = pause.count();
  wake();
}

// ---- The thread ----

void RemoteRobot::push(std::size_t arm, Event event) {
  const std::scoped_lock lock(mutex_);
  std::deque<Event>& inbox = inboxes_[arm];
  // A change of the connection makes earlier reports obsolete.
  if (std::holds_alternative<ArmConnection>(event)) inbox.clear();
  if (inbox.size() >= kInboxMax) {
    const auto oldest = std::ranges::find_if(
        inbox, [](const Event& old) { return std::holds_alternative<ArmFeedback>(old); });
    inbox.erase(oldest);
  }
  inbox.push_back(std::move(event));
}

void RemoteRobot::publish_up() {
  ++connection_;
  is_up_ = true;
  why_down_.clear();
  {
    const std::scoped_lock lock(mutex_);
    outbox_.clear();
    overflowed_ = false;
  }
  for (std::size_t arm = 0; arm < inboxes_.size(); ++arm) {
    push(arm, ArmConnection{true, {}, connection_});
  }
}

void RemoteRobot::publish_down(std::string why) {
  is_up_ = false;
  if (why == why_down_) return;
  why_down_ = std::move(why);
  for (std::size_t arm = 0; arm < inboxes_.size(); ++arm) {
    push(arm, ArmConnection{false, why_down_, connection_, is_in_use_});
  }
}

void RemoteRobot::run(std::stop_token stop) {
  milliseconds pause = kFirstPause;
  while (!stop.stop_requested()) {
    is_welcome_ = is_in_use_ = false;
    std::string why = converse(stop);
    if (stop.stop_requested()) return;
    pause = is_welcome_ ? kFirstPause : std::min(2 * pause, kLongestPause);
    publish_down(std::move(why));
    const std::int64_t cut = cut_ms_.exchange(-1);
    const auto until = Wall::now() + (cut >= 0 ? milliseconds(cut) : pause);
    while (!stop.stop_requested() && Wall::now() < until) {
      pollfd waits{wakes_.get(), POLLIN, 0};
      const auto left = std::chrono::ceil<milliseconds>(until - Wall::now());
      (void)poll(&waits, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
      std::uint64_t woken = 0;
      (void)!read(wakes_.get(), &woken, sizeof woken);
    }
  }
}

void RemoteRobot::say_hello(LineStream& stream) {
  stream.send(line_of(ServerMessage(hello_for(*cell_, robot_, session_))));
}

// Holds one connection. Returns why it ended.
std::string RemoteRobot::converse(const std::stop_token& stop) {
  auto socket = connect_to(endpoint_, stop);
  if (!socket) return socket.error().front().detail;
  LineStream stream(std::move(*socket), kLineMax, kUnsentMax);
  clock_.clear();
  say_hello(stream);
  const auto began = Wall::now();
  auto heard_at = began;
  const auto silence_max = std::max<Wall::duration>(
      kSilenceMin, kTimeoutsOfSilence * robot_.controller.feedback_timeout);
  std::size_t welcomed = 0;
  while (!stop.stop_requested()) {
    stream.flush();
    std::array<pollfd, 2> waits{
        {{stream.fd(), static_cast<short>(POLLIN | (stream.has_unsent() ? POLLOUT : 0)), 0},
         {wakes_.get(), POLLIN, 0}}};
    (void)poll(waits.data(), waits.size(), static_cast<int>(kFirstPause.count()));
    std::uint64_t woken = 0;
    if (waits[1].revents != 0) (void)!read(wakes_.get(), &woken, sizeof woken);
    if (cut_ms_ >= 0) return endpoint_.text() + ": the connection was cut";
    stream.receive();
    while (const auto line = stream.next_line()) {
      heard_at = Wall::now();
      if (auto why = hear(*line, welcomed)) return *why;
    }
    if (stream.end()) return endpoint_.text() + ": " + *stream.end();
    const auto now = Wall::now();
    if (!is_welcome_ && now - began > kWelcomeWait) {
      return endpoint_.text() + " sent no welcome: it is no controller, or it is busy";
    }
    if (now - heard_at > silence_max) {
      return (is_welcome_ ? endpoint_.text() + ": connected, but no report"
                          : "no answer from " + endpoint_.text()) +
             " for " +
             std::to_string(std::chrono::duration_cast<milliseconds>(silence_max).count()) + " ms";
    }
    if (is_welcome_ && beats_.exchange(false)) {
      stream.send(line_of(ServerMessage(Heartbeat{wall_ns(), {}})));
    }
    if (is_up_) send_waiting(stream);
  }
  return {};
}

// Handles a line of the controller. Returns why the connection must end.
std::optional<std::string> RemoteRobot::hear(const std::string& line, std::size_t& welcomed) {
  auto message = read_controller_line(line);
  if (!message) return endpoint_.text() + " sent a bad message: " + phrase(message.error());
  if (const auto* refusal = std::get_if<HelloRefusal>(&*message)) {
    is_in_use_ = refusal->pointer == "/session";
    return endpoint_.text() +
           " refused the connection: " + (refusal->pointer.empty() ? "" : refusal->pointer + ": ") +
           refusal->detail;
  }
  if (const auto* welcome = std::get_if<Welcome>(&*message)) {
    if (welcomed++ > 0) return endpoint_.text() + " sent a second welcome";
    if (auto fault = fault_of(*welcome)) return fault;
    is_welcome_ = true;
    beats_ = true;
    return std::nullopt;
  }
  if (!is_welcome_) return endpoint_.text() + " sent a message before its welcome";
  if (const auto* heartbeat = std::get_if<Heartbeat>(&*message)) {
    measure_clock(*heartbeat);
    // Commands need the controller's clock.
    if (!is_up_ && !clock_.empty()) publish_up();
    return std::nullopt;
  }
  return take(std::get<FeedbackMessage>(*message));
}

std::optional<std::string> RemoteRobot::take(const FeedbackMessage& feedback) {
  const auto arm = std::ranges::find_if(
      robot_.arms, [&](ArmId id) { return cell_->arm(id).name == feedback.arm; });
  if (arm == robot_.arms.end()) {
    return endpoint_.text() + " reports on an unknown arm \"" + feedback.arm + "\"";
  }
  const std::size_t joints =
      cell_->arm(*arm).joints.size() + cell_->arm(*arm).gripper_joints.size();
  if (feedback.positions.size() != joints) {
    return endpoint_.text() + " reports " + std::to_string(feedback.positions.size()) +
           " positions of arm \"" + feedback.arm + "\", which has " + std::to_string(joints) +
           " joints";
  }
  if (is_up_) push(static_cast<std::size_t>(arm - robot_.arms.begin()), feedback_of(feedback));
  return std::nullopt;
}

std::optional<std::string> RemoteRobot::fault_of(const Welcome& welcome) const {
  const std::string at = endpoint_.text();
  if (welcome.protocol != kArmProtocol) {
    return at + " speaks version " + std::to_string(welcome.protocol) +
           " of the protocol, this server version " + std::to_string(kArmProtocol);
  }
  if (welcome.robot != robot_.name) {
    return "robot \"" + welcome.robot + "\" answers at " + at + ", expected \"" + robot_.name +
           "\"";
  }
  const Hello hello = hello_for(*cell_, robot_, session_);
  if (welcome.arms.size() != hello.arms.size()) {
    return at + " has " + std::to_string(welcome.arms.size()) + " arms, the cell file " +
           std::to_string(hello.arms.size());
  }
  for (std::size_t a = 0; a < hello.arms.size(); ++a) {
    const Welcome::Arm& arm = welcome.arms[a];
    if (arm.name != hello.arms[a].name) {
      return at + " has arm \"" + arm.name + "\" where the cell file has \"" + hello.arms[a].name +
             "\"";
    }
    if (!std::ranges::equal(arm.joints, hello.arms[a].joints, {}, {}, &JointTerms::name)) {
      return at + ": the joints of arm \"" + arm.name + "\" differ from those of the cell file";
    }
  }
  const auto broken = [&](const std::string& what, double kept, double needed, const char* faster) {
    return at + " promises a " + what + " of " + text_of(kept) +
           " s, but the cell file relies on " + text_of(needed) + " s: raise controller." + what +
           " in the cell file, or " + faster;
  };
  if (welcome.reaction_s > hello.reaction_s) {
    return broken("reaction_s", welcome.reaction_s, hello.reaction_s, "make the controller faster");
  }
  if (welcome.feedback_period_s > hello.feedback_period_s) {
    return broken("feedback_period_s", welcome.feedback_period_s, hello.feedback_period_s,
                  "send reports more often");
  }
  return std::nullopt;
}

// The answer to a heartbeat was given, by assumption, in the middle of the round trip.
void RemoteRobot::measure_clock(const Heartbeat& heartbeat) {
  if (!heartbeat.controller_time_ns) return;
  const std::int64_t now = wall_ns();
  const std::int64_t round_trip = now - heartbeat.time_ns;
  if (round_trip < 0) return;
  if (clock_.size() >= kClockSamples) clock_.pop_front();
  clock_.push_back({Wall::duration(round_trip),
                    Duration(*heartbeat.controller_time_ns - heartbeat.time_ns - round_trip / 2)});
}

void RemoteRobot::send_waiting(LineStream& stream) {
  std::deque<Outgoing> all;
  bool overflowed = false;
  {
    const std::scoped_lock lock(mutex_);
    all = std::exchange(outbox_, {});
    overflowed = std::exchange(overflowed_, false);
  }
  const Duration offset = std::ranges::min(clock_, {}, &ClockSample::round_trip).offset;
  for (const Outgoing& one : all) {
    if (one.connection != connection_) continue;
    std::optional<Duration> start_at;
    if (const auto* follow = std::get_if<ArmCommand::Follow>(&one.command.what)) {
      start_at = follow->start_at.time_since_epoch() - Duration(wall_to_cell_ns_) + offset;
    }
    stream.send(
        line_of(message_of(one.command, *cell_, cell_->arm(robot_.arms[one.arm]).name, start_at)));
  }
  // A lost command leaves a gap in the numbers, so the connection is made again.
  if (overflowed) cut(milliseconds(0));
}

}  // namespace armloom
