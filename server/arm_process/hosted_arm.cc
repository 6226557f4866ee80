#include "server/arm_process/hosted_arm.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <variant>
#include <vector>

namespace armloom {

HostedArm::HostedArm(CellPtr cell, ArmId arm, std::unique_ptr<ArmController> controller)
    : cell_(std::move(cell)), arm_(arm), controller_(std::move(controller)) {
  feedback_.at_rest = true;
}

void HostedArm::pass_on(decltype(ArmCommand::what) what) {
  controller_->send({++inner_, std::move(what)});
}

void HostedArm::begin_session() {
  acknowledged_ = rejected_ = 0;
  why_rejected_.clear();
  is_motion_refused_ = false;
  passed_.clear();
  drops_motion_ = true;
  brake();
}

void HostedArm::brake() { pass_on(ArmCommand::Brake{}); }

// ---- Commands of the server ----

void HostedArm::obey(CommandNumber number, decltype(ArmCommand::what) what) {
  if (number != acknowledged_ + 1) return;
  acknowledged_ = number;
  if (std::holds_alternative<ArmCommand::Release>(what)) is_motion_refused_ = false;
  pass_on(std::move(what));
  passed_.emplace_back(inner_, number);
}

void HostedArm::follow(const Numbered<FollowMessage>& command, TimePoint start_at) {
  if (command.number != acknowledged_ + 1) return;
  auto trajectory = trajectory_of(command.what);
  if (!trajectory) {
    acknowledged_ = command.number;
    return reject(command.number, trajectory.error().front().detail);
  }
  is_motion_refused_ = false;
  obey(command.number,
       ArmCommand::Follow{std::move(*trajectory), start_at, Duration(command.what.from_ns),
                          Duration(command.what.authority_ns)});
}

void HostedArm::reject(CommandNumber number, std::string why) {
  rejected_ = number;
  why_rejected_ = std::move(why);
  is_motion_refused_ = true;
}

Result<TrajectoryPtr> HostedArm::trajectory_of(const FollowMessage& follow) const {
  const auto bad = [](const std::string& why) {
    return failure(Problem{ProblemKind::invalid, "bad-trajectory", "", why});
  };
  std::vector<JointId> joints;
  std::set<ArmId> arms;
  for (const JointTerms& terms : follow.joints) {
    const auto joint = cell_->find_joint(terms.name);
    if (!joint) return bad("the cell file has no joint " + terms.name);
    joints.push_back(*joint);
    if (const auto arm = cell_->joint(*joint).arm) arms.insert(*arm);
  }
  std::vector<Segment> segments;
  Duration start{};
  for (const FollowMessage::Piece& piece : follow.pieces) {
    Segment segment{start, Duration(piece.duration_ns), {}};
    segment.coefficients.resize(static_cast<Eigen::Index>(piece.coefficients.size()), 6);
    for (std::size_t row = 0; row < piece.coefficients.size(); ++row) {
      const std::vector<double>& of_joint = piece.coefficients[row];
      if (of_joint.size() != 6) return bad("a joint needs 6 coefficients in each piece");
      segment.coefficients.row(static_cast<Eigen::Index>(row)) =
          Eigen::Map<const Eigen::Matrix<double, 1, 6>>(of_joint.data());
    }
    start += segment.duration;
    segments.push_back(std::move(segment));
  }
  try {
    return std::make_shared<const Trajectory>(
        std::move(joints), std::vector<ArmId>(arms.begin(), arms.end()), std::move(segments));
  } catch (const std::invalid_argument& fault) {
    return bad(fault.what());
  }
}

// ---- Each control cycle ----

const ArmFeedback* HostedArm::tick(TimePoint now) {
  const bool rests = feedback_.at_rest && feedback_.phase != ArmFeedback::Phase::waiting;
  if (drops_motion_ && rests) {
    drops_motion_ = false;
    pass_on(ArmCommand::Release{});
  }
  bool has_report = false;
  while (const ArmFeedback* report = controller_->poll(now)) {
    has_report = true;
    feedback_ = *report;
    while (!passed_.empty() && passed_.front().first <= report->acknowledged) {
      if (passed_.front().first == report->rejected) {
        rejected_ = passed_.front().second;
        why_rejected_ = report->detail;
      }
      passed_.pop_front();
    }
    feedback_.acknowledged = acknowledged_;
    feedback_.rejected = rejected_;
    if (is_motion_refused_ && feedback_.at_rest) {
      feedback_.phase = ArmFeedback::Phase::fault;
      feedback_.detail = why_rejected_;
    }
  }
  return has_report ? &feedback_ : nullptr;
}

}  // namespace armloom
