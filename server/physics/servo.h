#pragma once

#include <vector>

#include "server/physics/mujoco_model.h"

namespace armloom {

// Natural frequency of the position loops (rad/s). A lower value suits weaker drives.
inline constexpr double kServoBandwidth_rad_s = 100.0;

// Position control of all driven links of a robot, by computed torque with an integral part:
//   torque = M(q) (a_ref + w^2 e + 2 w e' + 0.1 w^3 ∫e) + bias(q, q')
// within the effort limits. M and the bias (gravity and Coriolis) are those of `known`, the robot
// as the controller knows it: possibly without its payload, and with masses that are too large by a
// share. So the gains follow the reflected inertia. The integral part removes the offset that an
// unknown load or friction causes. It is frozen while a torque is at its limit.
class Servo {
 public:
  struct Reference {  // of one driven link; rad or m, s
    double position = 0.0;
    double velocity = 0.0;
    double acceleration = 0.0;
    bool drive_on = true;
  };

  Servo(MujocoModel& known, double mass_error)
      : known_(known), mass_error_(mass_error), integral_(known.driven().size(), 0.0) {}

  // Computes torques (N m, N) for one internal step of `plant`, and stores them in the plant's
  // qfrc_applied. One reference per driven link. Precondition: `plant` has the joints of `known`.
  void apply(const std::vector<Reference>& references, double step_s, MujocoModel& plant);
  // Clears the integral part of a driven link.
  void reset(std::size_t i) { integral_[i] = 0.0; }

 private:
  MujocoModel& known_;
  double mass_error_;
  std::vector<double> integral_;
  std::vector<double> acceleration_;  // scratch, by degree of freedom
  std::vector<double> torque_;
  std::vector<double> bias_;
};

}  // namespace armloom
