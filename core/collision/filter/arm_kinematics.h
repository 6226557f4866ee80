#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/collision/filter/kernel.h"
#include "core/collision/scene/planning_scene.h"
#include "core/model/cell.h"

namespace armloom {

// A body of the scene (scene_bodies.h), as part of an ArmKinematics. `frame` moves the body; -1 if
// the body is static. X_FP is the body's pose in that frame, or in the world if static.
struct KinematicBody {
  std::size_t body;  // index in PlanningScene::Bodies::bodies
  int frame;
  Eigen::Isometry3d X_FP;
  int capsules_begin;  // range in ArmKinematics::capsules()
  int capsules_end;
};

// One arm with its attached objects, in the data layout of the filter's kernels. Only movable
// joints become frames, each with its axis as z. A fixed link belongs to the frame that moves the
// link. Works for any tree of revolute, continuous, prismatic and mimic joints. The static links
// and objects of a scene form an ArmKinematics without frames. Immutable.
class ArmKinematics {
 public:
  // Contains the bodies of `arm`, or the static bodies if `arm` is nullopt.
  ArmKinematics(const PlanningScene::Bodies& bodies, std::optional<ArmId> arm);

  [[nodiscard]] std::optional<ArmId> arm() const { return arm_; }
  // Returns the joint of each row of the kernels' q. Includes joints upstream of the arm that no
  // arm moves.
  [[nodiscard]] const std::vector<JointId>& joints() const { return joints_; }
  [[nodiscard]] const std::vector<KinematicBody>& bodies() const { return bodies_; }
  [[nodiscard]] const std::vector<filter::Frame>& frames() const { return frames_; }
  [[nodiscard]] const std::vector<filter::Capsule>& capsules() const { return capsules_; }
  [[nodiscard]] int motion_bound_rows() const { return motion_bound_rows_; }
  [[nodiscard]] filter::ArmKinematics view() const;
  // Returns an upper bound (m) of the world coordinates of all its bodies and joints.
  [[nodiscard]] double extent_m() const { return extent_m_; }
  // Returns the frames from the root to this frame; empty for the world (-1).
  [[nodiscard]] std::span<const int> ancestors(int frame) const;
  [[nodiscard]] int common_ancestors(int capsule_a, int capsule_b) const;

 private:
  struct Carried {  // the frame that moves a link, and the link's pose in it
    int frame = -1;
    Eigen::Isometry3d X_FL = Eigen::Isometry3d::Identity();
    double reach_m = 0.0;  // bound of the distance of the link's origin from the world's
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

// Writes the pose of each frame in the world, in double: [frame][12], laid out like
// filter::Frame::C. `q`: one value per ArmKinematics::joints().
void place_frames(const ArmKinematics& kinematics, const double* q, double* frames);
// Returns the body's pose in the world. `frames`: output of place_frames(), or of a kernel.
// `stride`: distance of consecutive numbers in `frames` (filter::kLanes for a kernel).
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
// Returns a pair of capsules for the kernels, with a required distance. `margin_m`:
// filter::rounding_margin().
[[nodiscard]] filter::Pair kernel_pair(const NumberedCapsule& a, const NumberedCapsule& b,
                                       double limit_m, double margin_m);
// Returns the smallest float that is not below x.
[[nodiscard]] float round_up(double x);

}  // namespace armloom
