#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/holding.h"
#include "core/executive/job_intake.h"

namespace armloom {

// How far hands that hold one object may leave their pose relative to each other during a motion.
inline constexpr double kHandsApart_m = 0.002;
inline constexpr double kHandsApart_rad = 0.01;

// Returns the problem that a motion of these arms moves only some of several arms that hold an
// object together; nullopt if it does not.
[[nodiscard]] std::optional<Problem> find_moves_alone(const Cell& cell, const HandsOf& hands,
                                                      const std::vector<ArmId>& moved,
                                                      const std::string& pointer);

// Checks the motions of one job, in their order: hands that hold one object together keep their
// pose relative to each other. The pose counts in which they took the object; if they take it in
// this job, the pose in which the first motion with it begins.
//
// Samples each motion. At the samples, half the tolerance is allowed. Between samples, at most the
// other half is added: the samples are as dense as bounds on joint speeds and accelerations ask.
class HandsTogether {
 public:
  // `held`: at present.
  HandsTogether(const Cell& cell, const std::vector<Attachment>& held);

  // Adds the problem "hands-apart" at "/trajectory" if the hands leave their relative pose.
  // Precondition: the motion moves all arms of a hold, or none. `at`: positions of all other
  // joints.
  void find_apart(const PreparedMotion& motion, const HandsOf& hands, Configuration at,
                  Problems& problems);

 private:
  struct Together {
    std::vector<LinkId> hands;
    std::vector<Eigen::Isometry3d> X_FH;  // of each hand, in the frame of the first
  };
  const Cell& cell_;
  std::map<std::string, Together> by_object_;
};

}  // namespace armloom
