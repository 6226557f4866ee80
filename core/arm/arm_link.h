#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/arm/arm_controller.h"
#include "core/model/cell.h"

namespace armloom {

// The caller's end of the connection to one controller. Numbers the commands, repeats those that
// are not acknowledged, and decides what a report proves. Pure: time and reports are arguments.
//
//   state      | event                                               | next state
//   connecting | first report                                        | up
//   up         | last report older than half of feedback_timeout     | stale
//   stale      | report                                              | up
//   up, stale  | last report older than feedback_timeout, or         |
//              | the connection is down or new                       | lost
//   lost       | report of a connection that is up                   | up
//
// The age of a report is counted from its measurement on the controller's clock. The report with
// the shortest delay so far is taken as having no delay.
//
// Commands that would let the arm move wait until the link is up. A brake is sent in any state. It
// drops the commands that wait: a motion that was never sent counts as stopped at its start.
// Commands that are repeated after a brake do not let the arm move: an extend is repeated as a
// brake, a follow with an authority at its start. After a new connection, commands that the
// controller has not acknowledged are lost; the speed override is commanded again, before any
// motion.
class ArmLink {
 public:
  enum class State { connecting, up, stale, lost };
  // `assumed`: positions of the controller's joints before the first report.
  ArmLink(const ControllerDescription& promises, Eigen::VectorXd assumed);

  void command(ArmCommand::Follow follow);
  void command(ArmCommand::Extend extend);
  void command(ArmCommand::Brake brake);
  void command(ArmCommand::Release release);
  void command(ArmCommand::SetSpeed speed);
  // Sends what is due, polls the controller and updates the state. Call once per control cycle.
  void exchange(ArmController& controller, TimePoint now);
  // Sends the commands that may be sent now.
  void flush(ArmController& controller);

  [[nodiscard]] State state() const { return state_; }
  // Why the link is not up; empty if it is.
  [[nodiscard]] const std::string& detail() const { return detail_; }
  // Returns true if the controller was seen to serve another server before it connected.
  [[nodiscard]] bool was_in_use() const { return was_in_use_; }
  // Age of the last report at the last exchange(); Duration::max() before the first.
  [[nodiscard]] Duration age() const { return age_; }
  // The connection over which the last report came (ArmConnection::number); 0 before the first.
  [[nodiscard]] std::uint64_t connection() const { return heard_over_; }
  // Returns when the controller reported that it obeys the last brake; nullopt if it has not, or if
  // a motion was commanded since. A new connection forgets the brake.
  [[nodiscard]] std::optional<TimePoint> braking_since() const { return braking_since_; }
  // Returns true if the arm was stopped on its motion although no brake was commanded: its
  // controller has received nothing from the server for too long, or an operator stopped it there.
  [[nodiscard]] bool stopped_by_itself() const;
  // Returns the last report, seen through the commands since: a motion that the controller has not
  // acknowledged is `waiting`, a motion that it has lost or rejected is a `fault`.
  [[nodiscard]] const ArmFeedback& feedback() const { return seen_; }
  // Reports that were ignored because they were malformed or older than an earlier one.
  [[nodiscard]] std::uint64_t ignored() const { return ignored_; }

 private:
  using What = decltype(ArmCommand::what);

  void hear(const ArmFeedback& report, TimePoint now);
  void see(const ArmConnection& connection, TimePoint now);
  void connected_anew();
  void send(ArmController& controller, What what);
  void interpret();
  void synchronize(const ArmFeedback& first);

  Duration feedback_timeout_;
  State state_ = State::connecting;
  std::string detail_ = "no report yet";
  std::uint64_t connection_ = 0;
  bool was_in_use_ = false;
  bool is_new_ = true;  // no report of this connection has arrived yet

  std::optional<ArmCommand::SetSpeed> speed_;  // the last one: repeated on each new connection
  std::deque<What> waiting_;                   // not sent
  std::deque<ArmCommand> sent_;                // not acknowledged
  TimePoint now_{};
  TimePoint sent_at_{};       // last time that anything was sent
  CommandNumber number_ = 0;  // of the last command sent
  // The present motion: the follow command that was given last, until the release.
  struct Motion {
    Duration from;
    Duration authority;        // as commanded last
    CommandNumber number = 0;  // 0: not sent
    bool is_dropped = false;   // braked before it was sent
    // Why the controller does not have it any more: the connection broke before the controller
    // accepted it, or the controller was restarted. Empty if it was not lost.
    std::string lost = {};
  };
  std::optional<Motion> motion_;
  CommandNumber released_ = 0;  // number of the last release
  CommandNumber brake_ = 0;     // number of the last brake; 0 if a motion was commanded since
  std::optional<TimePoint> braking_since_;

  ArmFeedback heard_;  // the last report
  std::uint64_t heard_over_ = 0;
  ArmFeedback seen_;
  std::optional<Duration> fastest_;  // smallest arrival time minus controller_time
  TimePoint measured_at_{};
  Duration age_ = Duration::max();
  bool has_news_ = false;
  std::uint64_t ignored_ = 0;
};

[[nodiscard]] constexpr const char* to_string(ArmLink::State state) {
  switch (state) {
    case ArmLink::State::connecting:
      return "connecting";
    case ArmLink::State::up:
      return "up";
    case ArmLink::State::stale:
      return "stale";
    case ArmLink::State::lost:
      return "lost";
  }
  return nullptr;
}

}  // namespace armloom
