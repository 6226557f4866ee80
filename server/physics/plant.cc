#include "server/physics/plant.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/base/diagnostics.h"

namespace armloom {
namespace {

constexpr double kAtRest_rad_s = 1e-3;  // m/s for prismatic joints

}  // namespace

Result<Plant> Plant::create(CellPtr cell, const PlantOptions& options, Problems& warnings) {
  MjcfOptions real{.robot = options.robot, .payload = options.payload};
  MjcfOptions known = real;
  if (!options.is_payload_known) known.payload.reset();
  known.is_static = true;  // its contacts are not computed
  real.time_step = kStepMax;
  auto real_mjcf = make_mjcf(*cell, real, warnings);
  if (!real_mjcf) return failure(std::move(real_mjcf.error()));
  Problems same_warnings;
  auto known_mjcf = make_mjcf(*cell, known, same_warnings);
  if (!known_mjcf) return failure(std::move(known_mjcf.error()));
  auto real_model = MujocoModel::compile(std::move(*real_mjcf));
  if (!real_model) return failure(std::move(real_model.error()));
  auto known_model = MujocoModel::compile(std::move(*known_mjcf));
  if (!known_model) return failure(std::move(known_model.error()));
  Plant plant(std::move(cell), options, std::move(*real_model), std::move(*known_model));
  if (options.payload) {
    if (auto fault = plant.fault_of(*options.payload)) return failure(*std::move(fault));
  }
  return plant;
}

// Returns a problem if a drive cannot hold the payload in the present position. A joint's effort is
// a linear function of the payload's mass.
std::optional<Problem> Plant::fault_of(const Payload& payload) {
  const mjModel& model = mujoco_->model();
  mjData& data = mujoco_->data();
  const auto size = static_cast<std::size_t>(model.nv);
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  std::vector<double> effort(size), translation(3 * size);
  mj_rne(&model, &data, 0, effort.data());
  const Eigen::Isometry3d X_WL = mujoco_->pose(payload.link);
  const Eigen::Vector3d p_WC = X_WL * payload.p_LC_m;
  mj_jac(&model, &data, translation.data(), nullptr, p_WC.data(), mujoco_->body(payload.link));
  double holds_kg = std::numeric_limits<double>::infinity();
  const DrivenLink* weakest = nullptr;
  for (std::size_t i = 0; i < references_.size(); ++i) {
    const auto dof = static_cast<std::size_t>(mujoco_->dof(i));
    const DrivenLink& link = mujoco_->driven()[i];
    const double per_kg = -model.opt.gravity[2] * translation[2 * size + dof];
    const double own = effort[dof] - payload.mass_kg * per_kg;
    const double most_kg = (link.effort_max - std::copysign(1.0, per_kg) * own) / std::abs(per_kg);
    if (std::isnan(most_kg) || most_kg >= holds_kg) continue;
    holds_kg = most_kg;
    weakest = &link;
  }
  if (weakest == nullptr || payload.mass_kg <= holds_kg) return std::nullopt;
  return Problem{ProblemKind::invalid, "payload-too-heavy", "payload",
                 "too heavy: at home, the drives can hold at most " +
                     text_of(std::floor(100.0 * std::max(0.0, holds_kg)) / 100.0) + " kg at " +
                     payload.link + "; the effort limit of " + cell_->joint(weakest->driver).name +
                     " is " + text_of(weakest->effort_max) + " N m (N)",
                 payload.mass_kg};
}

Plant::Plant(CellPtr cell, const PlantOptions& options, std::unique_ptr<MujocoModel> real,
             std::unique_ptr<MujocoModel> known)
    : cell_(std::move(cell)),
      mujoco_(std::move(real)),
      known_(std::move(known)),
      servo_(std::make_unique<Servo>(*known_, options.mass_error)) {
  const std::vector<DrivenLink>& driven = mujoco_->driven();
  row_of_driven_.resize(driven.size());
  for (std::size_t j = 0; j < cell_->joints.size(); ++j) {
    const JointId joint{static_cast<std::uint32_t>(j)};
    std::optional<std::size_t> own;  // a mimic has another multiplier or comes later
    for (std::size_t i = 0; i < driven.size(); ++i) {
      if (driven[i].driver != joint) continue;
      row_of_driven_[i] = static_cast<Eigen::Index>(joints_.size());
      const bool is_plain = driven[i].multiplier == 1.0 && driven[i].offset == 0.0;
      if (!own && is_plain) own = i;
    }
    if (!own) continue;
    joints_.push_back(joint);
    driven_of_row_.push_back(*own);
  }
  references_.resize(driven.size());
  at_rest_.resize(driven.size());
  drive_on_.assign(joints_.size(), true);
  const Configuration home = cell_->home();
  Eigen::VectorXd position(static_cast<Eigen::Index>(joints_.size()));
  for (std::size_t r = 0; r < joints_.size(); ++r) {
    position[static_cast<Eigen::Index>(r)] = home[static_cast<Eigen::Index>(joints_[r].index())];
  }
  state_.torque = Eigen::VectorXd::Zero(position.size());
  place(position);
}

void Plant::place(const Eigen::VectorXd& position) {
  command_rate_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joints_.size()));
  throw_if_invalid(kStepMax, position, command_rate_);
  command_ = position;
  mjData& data = mujoco_->data();
  mj_resetData(&mujoco_->model(), &data);
  for (std::size_t i = 0; i < references_.size(); ++i) {
    const DrivenLink& link = mujoco_->driven()[i];
    data.qpos[mujoco_->dof(i)] = link.multiplier * position[row_of_driven_[i]] + link.offset;
    servo_->reset(i);
    mujoco_->set_lock(i, false);
    at_rest_[i] = {};
  }
  measure();
  state_.contacts.clear();
}

void Plant::throw_if_invalid(Duration period, const Eigen::VectorXd& position,
                             const Eigen::VectorXd& velocity) const {
  const auto size = static_cast<Eigen::Index>(joints_.size());
  if (position.size() != size || velocity.size() != size) {
    throw std::invalid_argument("Plant: a command must have " + std::to_string(size) + " entries");
  }
  if (!position.allFinite() || !velocity.allFinite()) {
    throw std::invalid_argument("Plant: a commanded number is not finite");
  }
  if (period <= Duration::zero()) throw std::invalid_argument("Plant: the period is not positive");
}

const PlantState& Plant::step(Duration period, const Eigen::VectorXd& position,
                              const Eigen::VectorXd& velocity) {
  throw_if_invalid(period, position, velocity);
  mjModel& model = mujoco_->model();
  mjData& data = mujoco_->data();
  const auto steps = (period.count() + kStepMax.count() - 1) / kStepMax.count();
  const double period_s = to_seconds(period);
  model.opt.timestep = period_s / static_cast<double>(steps);
  // The reference has a constant acceleration, plus a line for the rest of the way: zero if the
  // commands are samples of one motion, except for rounding.
  const Eigen::VectorXd acceleration = (velocity - command_rate_) / period_s;
  const Eigen::VectorXd rest = position - command_ - (command_rate_ + velocity) * (period_s / 2.0);
  state_.contacts.clear();
  for (std::int64_t k = 0; k < steps; ++k) {
    // The servo computes the torque of [t, t + h] from the state at t.
    const double t_s = static_cast<double>(k) * model.opt.timestep;
    for (std::size_t i = 0; i < references_.size(); ++i) {
      const Eigen::Index row = row_of_driven_[i];
      const DrivenLink& link = mujoco_->driven()[i];
      const double q = command_[row] + command_rate_[row] * t_s +
                       acceleration[row] * t_s * t_s / 2.0 + rest[row] * (t_s / period_s);
      references_[i] = {link.multiplier * q + link.offset,
                        link.multiplier * (command_rate_[row] + acceleration[row] * t_s),
                        link.multiplier * acceleration[row],
                        drive_on_[static_cast<std::size_t>(row)]};
    }
    servo_->apply(references_, model.opt.timestep, *mujoco_);
    mj_step(&model, &data);
    mujoco_->add_contacts(state_.contacts);
  }
  for (const mjtWarning warning : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (data.warning[warning].number > 0) {
      throw std::runtime_error("Plant: the simulation of the robot diverges");
    }
  }
  command_ = position;
  command_rate_ = velocity;
  lock_brakes(period);
  measure();
  return state_;
}

// With friction alone, a loaded joint would move slowly.
void Plant::lock_brakes(Duration period) {
  for (std::size_t i = 0; i < references_.size(); ++i) {
    if (drive_on_[static_cast<std::size_t>(row_of_driven_[i])] || mujoco_->is_locked(i)) continue;
    const bool rests = std::abs(mujoco_->data().qvel[mujoco_->dof(i)]) < kAtRest_rad_s;
    at_rest_[i] = rests ? at_rest_[i] + period : Duration{};
    if (at_rest_[i] >= kBrakeLocks) mujoco_->set_lock(i, true);
  }
}

void Plant::measure() {
  const auto size = static_cast<Eigen::Index>(joints_.size());
  state_.position.resize(size);
  state_.velocity.resize(size);
  for (std::size_t r = 0; r < joints_.size(); ++r) {
    const int dof = mujoco_->dof(driven_of_row_[r]);
    const auto row = static_cast<Eigen::Index>(r);
    state_.position[row] = mujoco_->data().qpos[dof];
    state_.velocity[row] = mujoco_->data().qvel[dof];
    state_.torque[row] = mujoco_->data().qfrc_applied[dof];
  }
}

void Plant::switch_drives(ArmId arm, bool on) {
  for (std::size_t i = 0; i < references_.size(); ++i) {
    const Eigen::Index row = row_of_driven_[i];
    const auto r = static_cast<std::size_t>(row);
    if (cell_->joint(joints_[r]).arm != arm) continue;
    const DrivenLink& link = mujoco_->driven()[i];
    mujoco_->model().dof_frictionloss[mujoco_->dof(i)] =
        link.friction + (on ? 0.0 : link.effort_max);
    mujoco_->set_lock(i, false);
    servo_->reset(i);
    at_rest_[i] = {};
    drive_on_[r] = on;
    if (!on) continue;
    command_[row] = state_.position[row];
    command_rate_[row] = 0.0;
  }
}

double Plant::energy_j() const {
  mjModel& model = mujoco_->model();
  mjData& data = mujoco_->data();
  mj_fwdPosition(&model, &data);
  mj_fwdVelocity(&model, &data);
  mj_energyPos(&model, &data);
  mj_energyVel(&model, &data);
  return data.energy[0] + data.energy[1];
}

}  // namespace armloom
