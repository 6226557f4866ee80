#include "core/arm/arm_link.h"

#include <algorithm>
#include <utility>

namespace armloom {
namespace {

using Phase = ArmFeedback::Phase;

// Largest drift between the two clocks that is not mistaken for a delay.
constexpr double kClockDrift = 1e-3;
// A command that is not acknowledged is sent again after this share of the feedback timeout.
constexpr int kResendShare = 2;

}  // namespace

ArmLink::ArmLink(const ControllerDescription& promises, Eigen::VectorXd assumed)
    : feedback_timeout_(promises.feedback_timeout) {
  heard_.measured = std::move(assumed);
  heard_.at_rest = true;
  seen_ = heard_;
}

// ---- Commands ----

void ArmLink::command(ArmCommand::Follow follow) {
  motion_ = Motion{.from = follow.from, .authority = follow.authority};
  waiting_.emplace_back(std::move(follow));
  interpret();
}

void ArmLink::command(ArmCommand::Extend extend) {
  if (!motion_ || std::exchange(motion_->authority, extend.authority) == extend.authority) return;
  // Only the last of several that wait counts.
  if (!waiting_.empty()) {
    if (auto* last = std::get_if<ArmCommand::Extend>(&waiting_.back())) {
      *last = extend;
      return;
    }
    if (auto* follow = std::get_if<ArmCommand::Follow>(&waiting_.back())) {
      follow->authority = extend.authority;
      return;
    }
  }
  waiting_.emplace_back(extend);
}

void ArmLink::command(ArmCommand::Brake brake) {
  const bool is_unsent = motion_ && motion_->number == 0;
  std::erase_if(waiting_, [](const What& what) {
    return std::holds_alternative<ArmCommand::Follow>(what) ||
           std::holds_alternative<ArmCommand::Extend>(what);
  });
  if (is_unsent) motion_->is_dropped = true;
  // When they are repeated, commands that are not acknowledged must not move the arm.
  for (ArmCommand& command : sent_) {
    if (auto* follow = std::get_if<ArmCommand::Follow>(&command.what)) {
      follow->authority = follow->from;
    } else if (std::holds_alternative<ArmCommand::Extend>(command.what)) {
      command.what = brake;
    }
  }
  waiting_.emplace_back(brake);
  interpret();
}

void ArmLink::command(ArmCommand::Release release) {
  motion_.reset();
  waiting_.emplace_back(release);
  interpret();
}

// Only the last of several that wait counts. It goes before a motion that waits.
void ArmLink::command(ArmCommand::SetSpeed speed) {
  speed_ = speed;
  std::erase_if(waiting_, [](const What& what) {
    return std::holds_alternative<ArmCommand::SetSpeed>(what);
  });
  waiting_.emplace_front(speed);
}

void ArmLink::flush(ArmController& controller) {
  if (state_ == State::up) {
    while (!waiting_.empty()) {
      What what = std::move(waiting_.front());
      waiting_.pop_front();
      send(controller, std::move(what));
    }
    interpret();
    return;
  }
  const auto is_brake = [](const What& what) {
    return std::holds_alternative<ArmCommand::Brake>(what);
  };
  for (const What& what : waiting_) {
    if (is_brake(what)) send(controller, what);
  }
  std::erase_if(waiting_, is_brake);
}

void ArmLink::send(ArmController& controller, What what) {
  const ArmCommand command{++number_, std::move(what)};
  if (std::holds_alternative<ArmCommand::Brake>(command.what) && brake_ == 0) brake_ = number_;
  if (std::holds_alternative<ArmCommand::Follow>(command.what)) {
    motion_->number = number_;
    brake_ = 0;
    braking_since_.reset();
  }
  if (std::holds_alternative<ArmCommand::Release>(command.what)) released_ = number_;
  sent_.push_back(command);
  sent_at_ = now_;
  controller.send(command);
}

// ---- Reports ----

bool ArmLink::stopped_by_itself() const {
  const bool is_accepted =
      motion_ && motion_->number != 0 && heard_.acknowledged >= motion_->number;
  return is_accepted && heard_.phase == Phase::stopped && brake_ == 0;
}

void ArmLink::exchange(ArmController& controller, TimePoint now) {
  now_ = now;
  has_news_ = false;
  const ArmConnection connection = controller.connection();
  if (connection.number != connection_) {
    connection_ = connection.number;
    connected_anew();
  }
  while (const ArmFeedback* report = controller.poll(now)) hear(*report, now);
  see(connection, now);
  interpret();
  flush(controller);
  if (sent_.empty() || !connection.is_up || now - sent_at_ < feedback_timeout_ / kResendShare) {
    return;
  }
  sent_at_ = now;
  for (const ArmCommand& command : sent_) controller.send(command);
}

// Commands that were under way are lost. The first report tells which ones arrived.
void ArmLink::connected_anew() {
  sent_.clear();
  is_new_ = true;
  if (state_ != State::connecting) state_ = State::lost;
}

// The first report of a connection: continues the numbers of the controller, which may have been
// restarted.
void ArmLink::synchronize(const ArmFeedback& first) {
  is_new_ = false;
  number_ = first.acknowledged;
  released_ = brake_ = 0;
  braking_since_.reset();
  fastest_.reset();
  if (speed_) command(ArmCommand::SetSpeed(*speed_));  // the controller may have been restarted
  if (!motion_ || motion_->number <= number_) return;
  motion_->lost = heard_.acknowledged >= motion_->number
                      ? "the controller has lost its motion: it was restarted"
                      : "the connection broke before the controller accepted the motion";
}

void ArmLink::hear(const ArmFeedback& report, TimePoint now) {
  const bool is_sound =
      report.measured.size() == heard_.measured.size() && report.measured.allFinite();
  const bool is_next = report.sequence > heard_.sequence && report.acknowledged <= number_;
  if (!is_sound || (!is_new_ && !is_next)) {
    ++ignored_;
    return;
  }
  // A controller that has forgotten commands was restarted.
  if (report.acknowledged < heard_.acknowledged) connected_anew();
  if (is_new_) synchronize(report);
  const Duration took = now.time_since_epoch() - report.controller_time;
  if (fastest_) {
    const Duration since = report.controller_time - heard_.controller_time;
    *fastest_ += from_seconds(kClockDrift * std::max(0.0, to_seconds(since)));
  }
  fastest_ = std::min(fastest_.value_or(took), took);
  heard_ = report;
  heard_over_ = connection_;
  measured_at_ = TimePoint(report.controller_time + *fastest_);
  has_news_ = true;
  if (brake_ != 0 && report.acknowledged >= brake_ && !braking_since_) {
    braking_since_ = measured_at_;
  }
  std::erase_if(sent_,
                [&](const ArmCommand& command) { return command.number <= report.acknowledged; });
}

void ArmLink::see(const ArmConnection& connection, TimePoint now) {
  if (state_ != State::connecting || has_news_) age_ = now - measured_at_;
  was_in_use_ = was_in_use_ || (state_ == State::connecting && connection.is_in_use);
  if (!connection.is_up) {
    if (state_ != State::connecting) state_ = State::lost;
    detail_ = connection.detail;
  } else if (state_ == State::connecting && !has_news_) {
    return;
  } else if (state_ == State::lost && !has_news_) {
    detail_ = "no report since the link was lost";
  } else if (age_ > feedback_timeout_) {
    state_ = State::lost;
    const auto ms = [](Duration time) {
      return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
    };
    detail_ = "no report for " + ms(age_) + " ms (limit " + ms(feedback_timeout_) + " ms)";
  } else if (age_ > feedback_timeout_ / 2) {
    state_ = State::stale;
    detail_ = "reports are late";
  } else {
    state_ = State::up;
    detail_.clear();
  }
}

// Sets seen_ from the last report and the commands since.
void ArmLink::interpret() {
  seen_ = heard_;
  if (!sent_.empty() || !waiting_.empty() || state_ != State::up) seen_.settled = false;
  const auto rest = [this](Phase phase, Duration at) {
    seen_.phase = phase;
    seen_.commanded_progress = seen_.measured_progress = seen_.authority = at;
    seen_.rests_at.reset();
  };
  if (!motion_) {
    if (heard_.acknowledged < released_ || !waiting_.empty()) rest(Phase::idle, Duration{});
    return;
  }
  if (motion_->is_dropped) return rest(Phase::stopped, motion_->from);
  if (!motion_->lost.empty()) {
    rest(Phase::fault, motion_->from);
    seen_.detail = motion_->lost;
  } else if (motion_->number == 0 || heard_.acknowledged < motion_->number) {
    rest(Phase::waiting, motion_->from);
  } else if (heard_.rejected == motion_->number) {
    seen_.phase = Phase::fault;
  } else if (heard_.phase == Phase::idle) {
    rest(Phase::fault, motion_->from);
    seen_.detail = "the controller has lost its motion; was it restarted?";
  }
}

}  // namespace armloom
