#include "core/executive/hands_together.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "core/model/kinematics.h"
#include "core/trajectory/set_joints.h"

namespace armloom {
namespace {

// More samples would keep the strand busy for too long.
constexpr double kSamplesMax = 20000;

// The joints between two links, over the world.
class Chain {
 public:
  Chain(const Cell& cell, LinkId a, LinkId b) {
    const Eigen::Vector3d root = add(cell, a);
    reach_m_ += (add(cell, b) - root).norm();
  }

  // Returns bounds of the second time derivatives of the position of one link in the frame of the
  // other (m/s^2), and of their relative rotation (rad/s^2). A serial chain: each turning joint is
  // at most reach_m_ from either link.
  [[nodiscard]] std::pair<double, double> accelerations(const Trajectory& motion,
                                                        const SegmentBounds& bounds) const {
    double speed = 0.0, acceleration = 0.0;           // of turning joints
    double speed_m_s = 0.0, acceleration_m_s2 = 0.0;  // of sliding joints
    for (const Driven& joint : joints_) {
      const auto moved = std::ranges::find(motion.joints(), joint.id);
      if (moved == motion.joints().end()) continue;
      const auto j = moved - motion.joints().begin();
      (joint.turns ? speed : speed_m_s) += joint.share * bounds.speed[j];
      (joint.turns ? acceleration : acceleration_m_s2) += joint.share * bounds.acceleration[j];
    }
    return {reach_m_ * (acceleration + speed * speed) + acceleration_m_s2 + 2.0 * speed * speed_m_s,
            acceleration + 1.5 * speed * speed};
  }

 private:
  struct Driven {
    JointId id;
    bool turns;
    double share;
  };
  // Returns the position of the root of the link's robot.
  Eigen::Vector3d add(const Cell& cell, LinkId id) {
    const Link* link = &cell.link(id);
    for (; link->parent; link = &cell.link(*link->parent)) {
      reach_m_ += link->X_PJ.translation().norm();
      if (!link->driver) continue;
      const Joint& joint = cell.joint(*link->driver);
      const bool turns = link->motion != JointKind::prismatic;
      const double share = std::abs(link->multiplier);
      if (!turns) {
        reach_m_ +=
            share * std::max(std::abs(joint.lower), std::abs(joint.upper)) + std::abs(link->offset);
      }
      joints_.push_back({*link->driver, turns, share});
    }
    return link->X_PJ.translation();
  }

  double reach_m_ = 0.0;
  std::vector<Driven> joints_;
};

// The pose of one hand relative to another one during a motion.
class RelativePose {
 public:
  RelativePose(const Cell& cell, const Trajectory& motion, Configuration at)
      : cell_(cell), motion_(motion), at_(std::move(at)) {}

  [[nodiscard]] Eigen::Isometry3d of(LinkId hand, LinkId first, Duration progress) {
    motion_.sample_positions(progress, q_);
    set_joints(at_, motion_, q_);
    forward_kinematics(cell_, at_, X_WL_);
    return X_WL_[first.index()].inverse(Eigen::Isometry) * X_WL_[hand.index()];
  }

 private:
  const Cell& cell_;
  const Trajectory& motion_;
  Configuration at_;
  Eigen::VectorXd q_;
  LinkPoses X_WL_;
};

struct Apart {
  Duration at{};
  double off_m = 0.0, off_rad = 0.0;
  bool is_too_long = false;
};

// Linear interpolation between two samples is off by at most h^2 / 8 times the second derivative.
std::optional<Apart> first_apart(const Trajectory& motion, const Chain& chain, LinkId hand,
                                 LinkId first, const Eigen::Isometry3d& X_FH, RelativePose& pose) {
  double samples = 0.0;
  for (std::size_t s = 0; s < motion.segment_count(); ++s) {
    const Segment segment = motion.segment(s);
    const double lasts_s = to_seconds(segment.duration);
    const auto [m_s2, rad_s2] = chain.accelerations(motion, bounds_of(segment, 0.0, lasts_s));
    const double per_s2 = std::max(m_s2 / (4.0 * kHandsApart_m), rad_s2 / (4.0 * kHandsApart_rad));
    const double count = std::ceil(lasts_s * std::sqrt(per_s2)) + 1.0;
    samples += count;
    if (samples > kSamplesMax) return Apart{.at = segment.start, .is_too_long = true};
    for (double i = 0.0; i <= count; ++i) {
      const Duration at = segment.start + from_seconds(lasts_s * i / count);
      const Eigen::Isometry3d X = pose.of(hand, first, at);
      const double off_m = (X.translation() - X_FH.translation()).norm();
      const double off_rad = (X.linear() - X_FH.linear()).norm() / std::numbers::sqrt2;
      if (off_m > kHandsApart_m / 2 || off_rad > kHandsApart_rad / 2)
        return Apart{at, off_m, off_rad};
    }
  }
  return std::nullopt;
}

Problem problem_of(const Cell& cell, const std::string& object, LinkId hand, LinkId first,
                   const Apart& apart) {
  char text[320];
  if (apart.is_too_long) {
    std::snprintf(text, sizeof text,
                  ": the motion is too long to be checked: split it at %.6g s, or make it slower",
                  to_seconds(apart.at));
  } else {
    std::snprintf(
        text, sizeof text,
        ": at %.6g s they are %.4g mm and %.4g rad from the pose relative to each other in which "
        "they took it; at most %.4g mm and %.4g rad are allowed: move them alike, or let it go "
        "with POST /scene/objects/",
        to_seconds(apart.at), 1e3 * apart.off_m, apart.off_rad, 1e3 * kHandsApart_m / 2,
        kHandsApart_rad / 2);
  }
  return {ProblemKind::invalid, "hands-apart", "/trajectory",
          cell.link(first).name + " and " + cell.link(hand).name + " hold " + object + " together" +
              text + (apart.is_too_long ? "" : object + "/detach"),
          to_seconds(apart.at)};
}

}  // namespace

HandsTogether::HandsTogether(const Cell& cell, const std::vector<Attachment>& held) : cell_(cell) {
  for (const Attachment& one : held) {
    if (one.others.empty()) continue;
    Together& together = by_object_[one.object.name];
    together.hands.push_back(one.link);
    for (const Attachment::Other& other : one.others) {
      together.hands.push_back(other.link);
      together.X_FH.push_back(one.X_LO * other.X_LO.inverse(Eigen::Isometry));
    }
  }
}

void HandsTogether::find_apart(const PreparedMotion& motion, const HandsOf& hands, Configuration at,
                               Problems& problems) {
  std::erase_if(by_object_, [&](const auto& known) {
    const auto now = hands.find(known.first);
    return now == hands.end() || now->second != known.second.hands;
  });
  const Trajectory& way = *motion.alternatives.front();
  RelativePose pose(cell_, way, std::move(at));
  for (const auto& [object, links] : hands) {
    const LinkId first = links.front();
    if (links.size() < 2 || std::ranges::count(way.arms(), *cell_.link(first).arm) == 0) continue;
    const auto [known, is_new] = by_object_.try_emplace(object, Together{links, {}});
    for (std::size_t i = 1; i < links.size(); ++i) {
      auto& X_FH = known->second.X_FH;
      if (is_new) X_FH.push_back(pose.of(links[i], first, Duration{}));
      const Chain chain(cell_, first, links[i]);
      const auto apart = first_apart(way, chain, links[i], first, X_FH[i - 1], pose);
      if (apart) return problems.push_back(problem_of(cell_, object, links[i], first, *apart));
    }
  }
}

std::optional<Problem> find_moves_alone(const Cell& cell, const HandsOf& hands,
                                        const std::vector<ArmId>& moved,
                                        const std::string& pointer) {
  const std::vector<SharedHold> holds = shared_holds(cell, hands);
  const SharedHold* broken = hold_broken_by(moved, holds);
  if (broken == nullptr) return std::nullopt;
  return Problem{ProblemKind::conflict, "moves-alone", pointer, text_of(*broken, cell),
                 broken->object};
}

HandsOf JobIntake::hands(const Ahead& ahead) const {
  if (ahead.hands) return *ahead.hands;
  HandsOf hands = hands_of(*scene_());
  tasks_.change_holding(*cell_, hands);
  return hands;
}

void JobIntake::find_hands_apart(const JobRequest& request, const PreparedMotion& motion,
                                 Ahead& ahead, Problems& problems) const {
  if (!ahead.hands) ahead.hands = hands(ahead);
  const std::string place = request.move_to ? "/move_to" : request.motions().front().place;
  for (const TrajectoryPtr& way : motion.alternatives) {
    auto alone = find_moves_alone(*cell_, *ahead.hands, way->arms(), place);
    if (alone) return problems.push_back(*std::move(alone));
  }
  HandsTogether(*cell_, scene_()->attachments())
      .find_apart(motion, *ahead.hands, ahead.rest, problems);
}

}  // namespace armloom
