#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/physics/mjcf.h"

struct mjModel_;
struct mjData_;

namespace armloom {

struct DeleteMujoco {
  void operator()(mjModel_* model) const;
  void operator()(mjData_* data) const;
};

// Two bodies that touch: names of links or objects, links first, in the order of the cell.
struct BodyContact {
  std::string body_a;
  std::string body_b;
  double depth_m;  // largest penetration of two shapes
};

// MuJoCo's model of a Mjcf with one state. Confined to one thread at a time. MuJoCo's warnings do
// not reach stderr or a file; its internal errors print a message and abort the process.
class MujocoModel {
 public:
  // Returns a Problem with MuJoCo's message if MuJoCo refuses the model.
  [[nodiscard]] static Result<std::unique_ptr<MujocoModel>> compile(Mjcf mjcf);

  [[nodiscard]] mjModel_& model() { return *model_; }
  [[nodiscard]] mjData_& data() { return *data_; }
  [[nodiscard]] const std::vector<DrivenLink>& driven() const { return mjcf_.driven; }
  // Index of driven()[i] in qpos and qvel.
  [[nodiscard]] int dof(std::size_t i) const { return dofs_[i]; }

  // Sets the positions of all driven links. q: one entry per joint of the cell.
  void set_positions(const Configuration& q);
  // Adds the contacts of the last collision check, one per pair of bodies.
  void add_contacts(std::vector<BodyContact>& contacts) const;
  // Number of a link or object in model(). Throws std::out_of_range if there is none of that name.
  [[nodiscard]] int body(std::string_view name) const;
  // Pose of a link or object in the world after the last kinematics. Throws std::out_of_range if
  // the model does not have a body of that name.
  [[nodiscard]] Eigen::Isometry3d pose(std::string_view name) const;

  // Locks driven()[i] at its present position, or unlocks it.
  void set_lock(std::size_t i, bool locked);
  [[nodiscard]] bool is_locked(std::size_t i) const;

 private:
  MujocoModel(Mjcf mjcf, mjModel_* model);

  Mjcf mjcf_;
  std::unique_ptr<mjModel_, DeleteMujoco> model_;
  std::unique_ptr<mjData_, DeleteMujoco> data_;
  std::vector<int> dofs_;
  std::vector<std::size_t> body_of_geom_;  // index into mjcf_.bodies
};

}  // namespace armloom
