#include "server/physics/servo.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

namespace armloom {

void Servo::apply(const std::vector<Reference>& references, double step_s, MujocoModel& plant) {
  const mjModel& model = known_.model();
  mjData& known = known_.data();
  mjData& data = plant.data();
  const auto size = static_cast<std::size_t>(model.nv);
  std::copy_n(data.qpos, size, known.qpos);
  std::copy_n(data.qvel, size, known.qvel);
  mj_kinematics(&model, &known);
  mj_comPos(&model, &known);
  mj_crb(&model, &known);
  mj_comVel(&model, &known);
  acceleration_.resize(size);
  torque_.resize(size);
  bias_.resize(size);
  mj_rne(&model, &known, 0, bias_.data());

  constexpr double w = kServoBandwidth_rad_s;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const Reference& reference = references[i];
    const int dof = known_.dof(i);
    const double error = reference.position - known.qpos[dof];
    const double rate_error = reference.velocity - known.qvel[dof];
    acceleration_[static_cast<std::size_t>(dof)] =
        reference.drive_on ? reference.acceleration + w * w * error + 2.0 * w * rate_error +
                                 0.1 * w * w * w * integral_[i]
                           : 0.0;
  }
  mj_mulM(&model, &known, torque_.data(), acceleration_.data());
  for (std::size_t i = 0; i < references.size(); ++i) {
    const int dof = known_.dof(i);
    const auto index = static_cast<std::size_t>(dof);
    const double limit = known_.driven()[i].effort_max;
    const double torque = (1.0 + mass_error_) * (torque_[index] + bias_[index]);
    data.qfrc_applied[dof] = references[i].drive_on ? std::clamp(torque, -limit, limit) : 0.0;
    if (references[i].drive_on && std::abs(torque) < limit) {
      integral_[i] += (references[i].position - known.qpos[dof]) * step_s;
    }
  }
}

}  // namespace armloom
