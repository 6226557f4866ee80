#include "test/experiments/open_places.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "core/collision/filter/kernel.h"

namespace armloom::experiments {
namespace {

constexpr Duration kStep = std::chrono::milliseconds(10);

ClearanceQuery check_of(const CellPtr& cell) {
  auto scene = PlanningScene::build(cell);
  if (!scene) throw std::runtime_error(scene.error().front().detail);
  return ClearanceQuery(*scene, {cell->clearances.clearance_m + OpenPlaces::kMargin_m,
                                 cell->clearances.self_clearance_m + OpenPlaces::kSelfMargin_m});
}

}  // namespace

void place(const Trajectory& motion, Duration time, Configuration& q) {
  thread_local Eigen::VectorXd position;
  motion.sample_positions(time, position);
  for (std::size_t j = 0; j < motion.joints().size(); ++j) {
    q[static_cast<Eigen::Index>(motion.joints()[j].index())] =
        position[static_cast<Eigen::Index>(j)];
  }
}

OpenPlaces::OpenPlaces(CellPtr cell) : cell_(std::move(cell)), check_(check_of(cell_)) {}

bool OpenPlaces::clear_alone(const Trajectory& motion) { return clear(motion, cell_->home()); }

bool OpenPlaces::clear_beside(const Trajectory& motion, ArmId arm, const Eigen::VectorXd& q) {
  Configuration rest = cell_->home();
  const std::vector<JointId>& joints = cell_->arm(arm).joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    rest[static_cast<Eigen::Index>(joints[i].index())] = q[static_cast<Eigen::Index>(i)];
  }
  return clear(motion, rest);
}

bool OpenPlaces::clear(const Trajectory& motion, const Configuration& rest) {
  std::array<Configuration, filter::kLanes> states;
  std::array<const Configuration*, filter::kLanes> pointers{};
  for (Duration time{}; time < motion.duration() + kStep;) {
    std::size_t count = 0;
    for (; count < states.size() && time < motion.duration() + kStep; ++count, time += kStep) {
      states[count] = rest;
      place(motion, time, states[count]);
      pointers[count] = &states[count];
    }
    if (check_.too_close({pointers.data(), count}) != 0) return false;
  }
  return true;
}

}  // namespace armloom::experiments
