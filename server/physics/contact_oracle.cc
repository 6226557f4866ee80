#include "server/physics/contact_oracle.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <stdexcept>

namespace armloom {

Result<ContactOracle> ContactOracle::create(CellPtr cell) {
  Problems warnings;  // of dynamics, which contacts do not depend on
  MjcfOptions options;
  options.contacts_max = kContactsMax;
  options.is_static = true;
  auto mjcf = make_mjcf(*cell, options, warnings);
  if (!mjcf) return failure(std::move(mjcf.error()));
  auto mujoco = MujocoModel::compile(std::move(*mjcf));
  if (!mujoco) return failure(std::move(mujoco.error()));
  return ContactOracle(std::move(cell), std::move(*mujoco));
}

std::vector<BodyContact> ContactOracle::contacts(const Configuration& q, double within_m) {
  if (static_cast<std::size_t>(q.size()) != cell_->joints.size()) {
    throw std::invalid_argument("ContactOracle: q has " + std::to_string(q.size()) +
                                " entries, the cell has " + std::to_string(cell_->joints.size()) +
                                " joints");
  }
  mjData& data = mujoco_->data();
  mujoco_->set_positions(q);
  std::fill_n(mujoco_->model().geom_margin, mujoco_->model().ngeom, within_m);
  data.warning[mjWARN_CONTACTFULL].number = 0;
  mj_kinematics(&mujoco_->model(), &data);
  mj_comPos(&mujoco_->model(), &data);
  mj_collision(&mujoco_->model(), &data);
  if (data.warning[mjWARN_CONTACTFULL].number > 0) {
    throw std::runtime_error("ContactOracle: more than " + std::to_string(kContactsMax) +
                             " contacts of shapes");
  }
  std::vector<BodyContact> contacts;
  mujoco_->add_contacts(contacts);
  return contacts;
}

}  // namespace armloom
