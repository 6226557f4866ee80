#include "core/collision/state/placed_cell.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace armloom {
PlacedCell::Side::Side(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm)
    : kinematics(bodies, arm),
      q(kinematics.joints().size() * kStatesAtOnce),
      frames(kinematics.frames().size() * 12 * kStatesAtOnce),
      axes(kinematics.frames().size() * 6 * kStatesAtOnce),
      capsules(kinematics.capsules().size() * 6 * kStatesAtOnce),
      ball(4 * kStatesAtOnce),
      spread(4 * static_cast<std::size_t>(
                     filter::spread_size(static_cast<int>(kinematics.capsules().size())))) {
  if (!arm) place();
}

void PlacedCell::Side::place() {
  const filter::Kernel& kernel = filter::best_kernel();
  kernel.place(kinematics.view(), q.data(), {frames.data(), axes.data(), capsules.data()});
  kernel.enclose(kinematics.view(), capsules.data(), nullptr, nullptr, ball.data(), spread.data());
}

PlacedCell::PlacedCell(const PlanningScene::Bodies& bodies, const PairLimits& limits)
    : bodies_(bodies), limits_(limits) {
  const std::size_t count = bodies.cell->arms.size();
  for (std::uint32_t a = 0; a < count; ++a) arms_.emplace_back(bodies, ArmId{a});
  arms_.emplace_back(bodies, std::nullopt);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) compare(a, b);
    compare(a, a);
    compare(a, count);
  }
  set_limits(limits);
}

void PlacedCell::compare(std::size_t a, std::size_t b) {
  PairSet pairs = pairs_between(bodies_, arms_[a].kinematics, arms_[b].kinematics);
  if (pairs.empty()) return;
  hits_.resize(std::max(hits_.size(), pairs.hits_max() + 1));
  comparisons_.push_back({a, b, std::move(pairs)});
}

void PlacedCell::set_limits(const PairLimits& limits) {
  limits_ = limits;
  for (Comparison& c : comparisons_) c.pairs.set_limits(limits);
}

void PlacedCell::place(std::span<const Configuration* const> states) {
  if (states.empty() || states.size() > kStatesAtOnce) {
    throw std::invalid_argument("ClearanceQuery: needs one to eight states");
  }
  for (Side& arm : std::span(arms_).first(arms_.size() - 1)) {
    const std::vector<JointId>& joints = arm.kinematics.joints();
    for (std::size_t lane = 0; lane < kStatesAtOnce; ++lane) {
      const Configuration& q = *states[std::min(lane, states.size() - 1)];
      for (std::size_t row = 0; row < joints.size(); ++row) {
        arm.q[row * kStatesAtOnce + lane] = q[static_cast<Eigen::Index>(joints[row].index())];
      }
    }
    arm.place();
  }
}

PlacedBody PlacedCell::body(std::size_t side, int index, std::size_t lane) const {
  const Side& arm = arms_[side];
  const KinematicBody& body = arm.kinematics.bodies()[static_cast<std::size_t>(index)];
  return {bodies_.bodies[body.body], body_pose(body, arm.frames.data() + lane, filter::kLanes)};
}

}  // namespace armloom
