#include "server/arm_process/robot_host.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace armloom {
namespace {

using std::chrono::milliseconds;

// If the loop is later than this, simulated time slips instead of running a burst of cycles.
constexpr milliseconds kCatchUpMax{50};
constexpr milliseconds kHelloWait{2000};
constexpr std::size_t kStrangersMax = 4;
constexpr std::size_t kUnreadMax = std::size_t{1} << 20;

std::string ms_text(std::chrono::nanoseconds time) {
  return std::to_string(std::chrono::duration_cast<milliseconds>(time).count()) + " ms";
}

}  // namespace

Result<std::unique_ptr<RobotHost>> RobotHost::listen(
    CellPtr cell, RobotId robot, const Endpoint& endpoint,
    std::vector<std::unique_ptr<ArmController>> controllers, Log log) {
  auto listening = listen_on(endpoint);
  if (!listening) return failure(std::move(listening.error()));
  Endpoint bound = bound_endpoint(endpoint, *listening);
  std::unique_ptr<RobotHost> host(new RobotHost(std::move(cell), robot, std::move(bound),
                                                std::move(*listening), std::move(log)));
  for (std::size_t a = 0; a < controllers.size(); ++a) {
    host->arms_.emplace_back(host->cell_, host->robot_.arms[a], std::move(controllers[a]));
  }
  return host;
}

RobotHost::RobotHost(CellPtr cell, RobotId robot, Endpoint endpoint, Descriptor listening, Log log)
    : cell_(std::move(cell)),
      robot_(cell_->robots[robot.index()]),
      endpoint_(std::move(endpoint)),
      listening_(std::move(listening)),
      log_(std::move(log)) {}

RobotHost::~RobotHost() {
  if (endpoint_.is_unix()) unlink(endpoint_.path.c_str());
}

Duration RobotHost::clock() const { return Wall::now() - began_; }

// ---- The loop ----

void RobotHost::run(const std::function<bool()>& ends) {
  Wall::time_point due = Wall::now();
  bool is_ending = false;
  for (;;) {
    if (!is_ending && ends()) {
      is_ending = true;
      brake_all();
    }
    wait(due);
    watch_server();  // before it reads lines that arrived while this process was suspended
    listen_to_server();
    greet();
    const auto now = Wall::now();
    if (now - due > kCatchUpMax) {
      slip_ += now - due;
      log_({LogLine::Level::warning, "the control loop was late by " + ms_text(now - due) +
                                         ": the arm stood still for this time"});
      if (server_ && now - due > timeout_) brake_all();
      due = now;
    }
    for (; due <= now; due += kControlPeriod) cycle(due);
    if (server_) server_->flush();
    if (is_ending && std::ranges::all_of(arms_, &HostedArm::is_at_rest)) return;
  }
}

void RobotHost::cycle(Wall::time_point due) {
  const Duration clock = due - began_;
  simulated_ = TimePoint(clock - slip_);
  for (HostedArm& arm : arms_) {
    const ArmFeedback* report = arm.tick(simulated_);
    if (report == nullptr || !server_) continue;
    FeedbackMessage message = message_of(*report, arm.name());
    message.time_ns = clock.count();
    server_->send(line_of(ControllerMessage(std::move(message))));
  }
}

void RobotHost::wait(Wall::time_point due) {
  std::vector<pollfd> waits{{listening_.get(), POLLIN, 0}};
  for (const Peer& peer : strangers_) waits.push_back({peer.stream.fd(), POLLIN, 0});
  if (server_) {
    const short out = server_->has_unsent() ? POLLOUT : 0;
    waits.push_back({server_->fd(), static_cast<short>(POLLIN | out), 0});
  }
  const auto left = std::max(due - Wall::now(), Wall::duration(0));
  const timespec until{0, static_cast<long>(std::min<std::int64_t>(left.count(), 999'999'999))};
  (void)ppoll(waits.data(), waits.size(), &until, nullptr);
}

void RobotHost::watch_server() {
  const auto silent = Wall::now() - heard_at_;
  if (!server_ || is_silent_ || silent <= timeout_) return;
  is_silent_ = true;
  brake_all();
  log_({LogLine::Level::warning, "no heartbeat for " + ms_text(silent) + ": the arms brake"});
}

void RobotHost::brake_all() {
  for (HostedArm& arm : arms_) arm.brake();
}

// ---- Servers ----

void RobotHost::greet() {
  while (strangers_.size() < kStrangersMax) {
    Descriptor socket = accept_from(listening_);
    if (!socket.is_open()) break;
    strangers_.push_back({LineStream(std::move(socket), kLineMax, kUnreadMax), Wall::now()});
  }
  for (std::size_t i = 0; i < strangers_.size();) {
    if (greet(strangers_[i])) {
      strangers_.erase(strangers_.begin() + static_cast<std::ptrdiff_t>(i));
    } else {
      ++i;
    }
  }
}

// Returns true if the peer is no stranger any more: it is the server now, or was refused.
bool RobotHost::greet(Peer& peer) {
  peer.stream.receive();
  const auto line = peer.stream.next_line();
  if (!line) return peer.stream.end() || Wall::now() - peer.since > kHelloWait;
  const auto refuse = [&](HelloRefusal refusal) {
    log_({LogLine::Level::warning, "a connection was refused: " + refusal.detail});
    peer.stream.send(line_of(ControllerMessage(std::move(refusal))));
    peer.stream.flush();
    return true;
  };
  const auto message = read_server_line(*line);
  if (!message) {
    const Problem& first = message.error().front();
    return refuse({first.detail, first.pointer});
  }
  const auto* hello = std::get_if<Hello>(&*message);
  if (hello == nullptr) return refuse({"the first message must be a hello", "/type"});
  if (auto refusal = objection(*hello)) return refuse(std::move(*refusal));
  answer(std::move(peer), *hello);
  return true;
}

std::optional<HelloRefusal> RobotHost::objection(const Hello& hello) const {
  if (hello.protocol != kArmProtocol) {
    return HelloRefusal{"the server speaks version " + std::to_string(hello.protocol) +
                            " of the protocol, this controller version " +
                            std::to_string(kArmProtocol),
                        "/protocol"};
  }
  if (hello.robot != robot_.name) {
    return HelloRefusal{
        "robot \"" + robot_.name + "\" answers here, expected \"" + hello.robot + "\"", "/robot"};
  }
  if (server_ && hello.session != session_) {
    return HelloRefusal{"another server is connected (session " + session_ + "): end it first",
                        "/session"};
  }
  const std::vector<ArmTerms> own = hello_for(*cell_, robot_, {}).arms;
  if (own.size() != hello.arms.size()) {
    return HelloRefusal{"the server expects " + std::to_string(hello.arms.size()) +
                            " arms, the controller has " + std::to_string(own.size()),
                        "/arms"};
  }
  for (std::size_t a = 0; a < own.size(); ++a) {
    const std::string place = "/arms/" + std::to_string(a);
    const ArmTerms& asked = hello.arms[a];
    if (asked.name != own[a].name) {
      return HelloRefusal{
          "the controller has arm \"" + own[a].name + "\", not \"" + asked.name + "\"",
          place + "/name"};
    }
    if (!std::ranges::equal(asked.joints, own[a].joints, {}, &JointTerms::name,
                            &JointTerms::name)) {
      return HelloRefusal{
          "the joints of arm \"" + asked.name + "\" differ from those of the controller",
          place + "/joints"};
    }
    for (std::size_t j = 0; j < own[a].joints.size(); ++j) {
      const auto differs = [&](double JointTerms::*limit) {
        return asked.joints[j].*limit != own[a].joints[j].*limit;
      };
      if (differs(&JointTerms::velocity) || differs(&JointTerms::acceleration) ||
          differs(&JointTerms::brake)) {
        return HelloRefusal{"the limits of " + asked.joints[j].name +
                                " differ from those of the controller: use one cell file for both",
                            place + "/joints/" + std::to_string(j)};
      }
    }
  }
  return std::nullopt;
}

void RobotHost::answer(Peer peer, const Hello& hello) {
  // The commands of a connection that this one replaces are never read.
  if (server_) log_({LogLine::Level::info, "the server connected again"});
  brake_all();
  if (hello.session != session_) {
    session_ = hello.session;
    for (HostedArm& arm : arms_) arm.begin_session();
  }
  server_ = std::move(peer.stream);
  timeout_ = from_seconds(hello.timeout_s);
  heard_at_ = Wall::now();
  is_silent_ = false;
  Welcome welcome{.protocol = kArmProtocol,
                  .robot = robot_.name,
                  .arms = {},
                  .reaction_s = to_seconds(kControlPeriod),
                  .feedback_period_s = to_seconds(robot_.controller.feedback_period)};
  for (const ArmTerms& arm : hello.arms) {
    Welcome::Arm& told = welcome.arms.emplace_back(Welcome::Arm{arm.name, {}});
    for (const JointTerms& joint : arm.joints) told.joints.push_back(joint.name);
  }
  server_->send(line_of(ControllerMessage(std::move(welcome))));
  log_({LogLine::Level::info, "connected", {{"session", session_}, {"cell", hello.cell}}});
}

void RobotHost::lose_server(std::string why) {
  server_.reset();
  brake_all();
  log_({LogLine::Level::warning, "the server is gone, the arms brake: " + why});
}

void RobotHost::listen_to_server() {
  if (!server_) return;
  server_->receive();
  while (const auto line = server_->next_line()) {
    const auto message = read_server_line(*line);
    if (!message) {
      const Problem& first = message.error().front();
      server_->send(line_of(ControllerMessage(HelloRefusal{first.detail, first.pointer})));
      server_->flush();
      return lose_server("it sent a bad message: " + first.pointer + ": " + first.detail);
    }
    heard_at_ = Wall::now();
    is_silent_ = false;
    obey(*message);
    if (!server_) return;
  }
  if (server_->end()) lose_server(*server_->end());
}

HostedArm* RobotHost::find(const std::string& arm) {
  const auto found = std::ranges::find(arms_, arm, &HostedArm::name);
  return found == arms_.end() ? nullptr : &*found;
}

void RobotHost::obey(const ServerMessage& message) {
  if (const auto* heartbeat = std::get_if<Heartbeat>(&message)) {
    server_->send(line_of(ControllerMessage(Heartbeat{heartbeat->time_ns, clock().count()})));
    return;
  }
  if (std::holds_alternative<Hello>(message)) return lose_server("it sent a second hello");
  const auto to_arm = [this](const auto& command, auto obeys) {
    HostedArm* arm = find(command.arm);
    if (arm == nullptr) return lose_server("it commands an unknown arm \"" + command.arm + "\"");
    obeys(*arm);
  };
  if (const auto* follow = std::get_if<Numbered<FollowMessage>>(&message)) {
    const auto& start_at = follow->what.start_at_ns;
    to_arm(*follow, [&](HostedArm& arm) {
      arm.follow(*follow, start_at ? TimePoint(Duration(*start_at) - slip_) : simulated_);
    });
  } else if (const auto* extend = std::get_if<Numbered<ExtendMessage>>(&message)) {
    to_arm(*extend, [&](HostedArm& arm) {
      arm.obey(extend->number, ArmCommand::Extend{Duration(extend->what.authority_ns)});
    });
  } else if (const auto* brake = std::get_if<Numbered<BrakeMessage>>(&message)) {
    to_arm(*brake, [&](HostedArm& arm) {
      arm.obey(brake->number, ArmCommand::Brake{static_cast<StopCategory>(brake->what.category)});
    });
  } else if (const auto* speed = std::get_if<Numbered<SetSpeedMessage>>(&message)) {
    to_arm(*speed, [&](HostedArm& arm) {
      arm.obey(speed->number, ArmCommand::SetSpeed{speed->what.share, speed->what.brake});
    });
  } else {
    const auto& release = std::get<Numbered<ReleaseMessage>>(message);
    to_arm(release, [&](HostedArm& arm) { arm.obey(release.number, ArmCommand::Release{}); });
  }
}

}  // namespace armloom
