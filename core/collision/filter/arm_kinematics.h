#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/collision/filter/kernel.h"
#include "core/collision/scene/planning_scene.h"
#include "core/model/cell.h"

namespace armloom {

// A body (scene_bodies.h) of a kinematics: the frame that carries it (-1: it stands in the world)
// and its capsules in the filter.
struct KinematicBody {
  std::size_t body;  // in PlanningScene::Bodies::bodies
  int frame;
  Eigen::Isometry3d X_FP;
  int capsules_begin;
  int capsules_end;
};

// One arm, with what it holds, as the filter's kernels want it: only what moves is a frame, fixed
// links are folded into the frame that carries them, every frame's joint turns about its z. Works
// for any tree of revolute, continuous, prismatic and mimic joints. Or all that stands still,
// static links and objects: a kinematics without frames. Immutable.
class ArmKinematics {
 public:
  // No arm: what stands still.
  ArmKinematics(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm);

  [[nodiscard]] std::optional<ArmId> arm() const { return arm_; }
  // Rows of the q that the kernels take. Joints upstream that no arm moves are among them.
  [[nodiscard]] const std::vector<JointId>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<KinematicBody>& bodies() const { return bodies_; }
  [[nodiscard]] const std::vector<filter::Frame>& frames() const { return frames_; }
  [[nodiscard]] const std::vector<filter::Capsule>& capsules() const { return capsules_; }
  [[nodiscard]] int motion_bound_rows() const { return motion_bound_rows_; }
  [[nodiscard]] filter::ArmKinematics view() const;
  // No point of a body, nor any joint, ever has a larger coordinate in the world (m).
  [[nodiscard]] double extent_m() const { return extent_m_; }
  // The frames that carry one, itself the last; none of the world (-1).
  [[nodiscard]] std::span<const int> ancestors(int frame) const;
  // How many ancestors two capsules share.
  [[nodiscard]] int common_ancestors(int capsule_a, int capsule_b) const;

 private:
  struct Carried {  // a link: the frame that carries it, and where in it
    int frame = -1;
    Eigen::Isometry3d X_FL = Eigen::Isometry3d::Identity();
    double reach_m = 0.0;  // of the link's origin from the world's, at most
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

// The pose of each frame of one configuration, in double: [frame][12] as filter::Frame::C.
// q as ArmKinematics::joints.
void place_frames(const ArmKinematics& kinematics, const double* q, double* frames);
// Where a body is; `frames` as above, `stride` between consecutive numbers.
[[nodiscard]] Eigen::Isometry3d body_pose(const KinematicBody& body, const double* frames,
                                          int stride = 1);

// A capsule of a body, fixed in the world or in a frame.
[[nodiscard]] filter::Capsule kernel_capsule(const Eigen::Isometry3d& X_FP,
                                             const Eigen::Vector3d& p_PA,
                                             const Eigen::Vector3d& p_PB, double radius_m);
// One of the capsules that the kernels know by their numbers.
struct NumberedCapsule {
  int number;
  const filter::Capsule& capsule;
};
// What the kernel needs to know of a pair; `margin_m` is the rounding margin.
[[nodiscard]] filter::Pair kernel_pair(const NumberedCapsule& a, const NumberedCapsule& b,
                                       double limit_m, double margin_m);
// The smallest float not below x.
[[nodiscard]] float round_up(double x);

}  // namespace armloom
