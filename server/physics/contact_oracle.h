#pragma once

#include <memory>
#include <vector>

#include "server/physics/mujoco_model.h"

namespace armloom {

// Finds contacts of all robots and objects of a cell with MuJoCo. Shares the model with
// core/collision and core/audit, and the convex pieces of meshes with core/collision. The pieces
// fill some concave parts of meshes, so two bodies there may be reported although they are
// centimeters apart. Confined to one thread at a time.
class ContactOracle {
 public:
  // Returns the problems of make_mjcf() or MujocoModel::compile().
  [[nodiscard]] static Result<ContactOracle> create(CellPtr cell);

  // Returns every pair of bodies that are at most `within_m` apart in q and may not touch (mjcf.h),
  // in no particular order. Apart, depth_m is minus the distance. q: one entry per joint of the
  // cell; otherwise throws std::invalid_argument. Throws std::runtime_error if more than
  // kContactsMax pairs of shapes are that close.
  [[nodiscard]] std::vector<BodyContact> contacts(const Configuration& q, double within_m = 0.0);
  static constexpr int kContactsMax = 5000;

  // Pose of a link or object in the world in the configuration of the last contacts().
  [[nodiscard]] Eigen::Isometry3d pose(std::string_view body) const { return mujoco_->pose(body); }

 private:
  ContactOracle(CellPtr cell, std::unique_ptr<MujocoModel> mujoco)
      : cell_(std::move(cell)), mujoco_(std::move(mujoco)) {}

  CellPtr cell_;
  std::unique_ptr<MujocoModel> mujoco_;
};

}  // namespace armloom
