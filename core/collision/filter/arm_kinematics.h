#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/collision/filter/kernel.h"
#include "core/collision/scene/planning_scene.h"
#include "core/model/cell.h"

namespace armloom {

// A body (scene_bodies.h): the frame that moves it (-1: static) and its capsules in the filter.
struct KinematicBody {
  std::size_t body;  // in PlanningScene::Bodies::bodies
  int frame;
  Eigen::Isometry3d X_FP;
  int capsules_begin;
  int capsules_end;
};

// One arm with its attached objects, in the form of the filter's kernels. Only movable joints
// become frames, each with its axis as z; fixed links belong to the frame that moves them. Works
// for any tree of revolute, continuous, prismatic and mimic joints. Static links and objects form a
// kinematics without frames. Immutable.
class ArmKinematics {
 public:
  // nullopt: static bodies.
  ArmKinematics(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm);

  [[nodiscard]] std::optional<ArmId> arm() const { return arm_; }
  // Rows of the kernels' q, including upstream joints that no arm moves.
  [[nodiscard]] const std::vector<JointId>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<KinematicBody>& bodies() const { return bodies_; }
  [[nodiscard]] const std::vector<filter::Frame>& frames() const { return frames_; }
  [[nodiscard]] const std::vector<filter::Capsule>& capsules() const { return capsules_; }
  [[nodiscard]] int motion_bound_rows() const { return motion_bound_rows_; }
  [[nodiscard]] filter::ArmKinematics view() const;
  // Upper bound of all world coordinates of its bodies and joints (m).
  [[nodiscard]] double extent_m() const { return extent_m_; }
  // Returns the frames from the root to this frame; empty for the world (-1).
  [[nodiscard]] std::span<const int> ancestors(int frame) const;
  [[nodiscard]] int common_ancestors(int capsule_a, int capsule_b) const;

 private:
  struct Carried {  // the frame that moves a link, and its pose there
    int frame = -1;
    Eigen::Isometry3d X_FL = Eigen::Isometry3d::Identity();
    double reach_m = 0.0;  // upper bound, from the world's origin to the link's
  };
  Carried carry(const Cell& cell, LinkId link, std::vector<int>& seen,
                std::vector<Carried>& carried);
  void add_body(const PlanningScene::Bodies& bodies, std::size_t body, const Carried& carried);

  std::optional<ArmId> arm_;
  std::vector<JointId> joints_;
  std::vector<filter::Frame> frames_;
  std::vector<int> ancestors_;
  std::vector<int> ancestors_begin_;  // by frame
  std::vector<int> depth_;            // by frame
  std::vector<filter::Capsule> capsules_;
  std::vector<KinematicBody> bodies_;
  int motion_bound_rows_ = 0;
  double extent_m_ = 0.0;
};

// Writes the pose of each frame, in double: [frame][12] as filter::Frame::C. `q` as
// ArmKinematics::joints.
void place_frames(const ArmKinematics& kinematics, const double* q, double* frames);
// `frames` as above; `stride` between consecutive numbers.
[[nodiscard]] Eigen::Isometry3d body_pose(const KinematicBody& body, const double* frames,
                                          int stride = 1);

[[nodiscard]] filter::Capsule kernel_capsule(const Eigen::Isometry3d& X_FP,
                                             const Eigen::Vector3d& p_PA,
                                             const Eigen::Vector3d& p_PB, double radius_m);
// A capsule with its index in the kernels' arrays.
struct NumberedCapsule {
  int number;
  const filter::Capsule& capsule;
};
// `margin_m`: rounding margin.
[[nodiscard]] filter::Pair kernel_pair(const NumberedCapsule& a, const NumberedCapsule& b,
                                       double limit_m, double margin_m);
// Returns the smallest float that is not below x.
[[nodiscard]] float round_up(double x);

}  // namespace armloom
