#include "server/import/limit_guesses.h"

namespace armloom {
namespace {

// Slow and short enough for any robot that is built.
constexpr double kAngle_rad = 1.0;
constexpr double kSpeed_rad_s = 0.5;
constexpr double kLength_m = 0.1;
constexpr double kSpeed_m_s = 0.05;

}  // namespace

std::map<std::string, JointLimitsDescription> guess_limits(const RobotTree& tree,
                                                           const RobotSemantics::JointSet& joints,
                                                           const LimitsFile* file) {
  std::map<std::string, JointLimitsDescription> guesses;
  for (const std::size_t index : joints) {
    const TreeLink& link = tree.links[index];
    if (!link.joint.is_independent()) continue;
    JointLimitsDescription filed;
    if (file != nullptr) {
      const auto found = file->joints.find(link.joint.name);
      if (found != file->joints.end()) filed = found->second.limits;
    }
    const bool slides = link.joint.motion == JointKind::prismatic;
    const UrdfLimits& urdf = link.joint.limits;
    JointLimitsDescription guess;
    if (!urdf.velocity && !filed.velocity) guess.velocity = slides ? kSpeed_m_s : kSpeed_rad_s;
    // Of one bound the other follows (URDF: zero).
    const bool bounded = urdf.lower || urdf.upper || filed.lower || filed.upper;
    if (link.joint.motion != JointKind::continuous && !bounded) {
      guess.lower = slides ? 0.0 : -kAngle_rad;
      guess.upper = slides ? kLength_m : kAngle_rad;
    }
    if (slides) guess.keys = {"velocity_m_s", "lower_m", "upper_m"};
    if (guess.velocity || guess.lower) guesses[link.joint.name] = guess;
  }
  return guesses;
}

}  // namespace armloom
