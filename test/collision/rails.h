#pragma once

#include <cmath>
#include <optional>

#include "core/collision/check/motion_checker.h"
#include "test/collision/small_cell.h"

namespace armloom::rails {

// Spheres on rails, whose conflicts are known in closed form.

using namespace std::chrono_literals;

inline constexpr double kRadius_m = 0.05;
inline constexpr double kClearance_m = 0.02;
inline constexpr double kTracking_m = 0.001;
inline constexpr double kApart_m = 2 * kRadius_m + kClearance_m;  // between two centers
inline constexpr double kSpeed_m_s = 0.5;

inline void add_rail(Cell& cell, const std::string& name, const Eigen::Isometry3d& X_WB,
                     const Eigen::Vector3d& along) {
  const ArmId arm = small::add_robot(cell, name, X_WB, {along}, {0.0, kRadius_m});
  Joint& joint = cell.joints.back();
  joint.kind = JointKind::prismatic;
  joint.lower = -2.0;
  joint.upper = 2.0;
  Link& link = cell.links.back();
  link.motion = JointKind::prismatic;
  link.shapes.clear();
  small::add_shape(link, Sphere{kRadius_m}, small::at_xyz(0, 0, 0));
  cell.arms[arm.index()].home[0] = 1.5;
}

inline const ArmId kX{0};       // along x at y = 0
inline const ArmId kY{1};       // along y at x = 0
inline const ArmId kSecond{2};  // along x at y = 1

struct Rails {
  Rails() {
    Cell made;
    made.clearances.clearance_m = kClearance_m;
    add_rail(made, "x", small::at_xyz(0, 0, 0), Eigen::Vector3d::UnitX());
    add_rail(made, "y", small::at_xyz(0, 0, 0), Eigen::Vector3d::UnitY());
    add_rail(made, "second", small::at_xyz(0, 1, 0), Eigen::Vector3d::UnitX());
    // A post beside x's rail, far from the other arms.
    Link post = small::static_link("post", RobotId{1}, small::at_xyz(-1.8, 0, 0));
    small::add_shape(post, Sphere{kRadius_m}, small::at_xyz(0, 0, 0));
    small::add_link(made, post);
    cell = small::shared(std::move(made));
    question.rest = cell->home();
    question.method = Coordinated{kTracking_m};
    checker.emplace(*PlanningScene::build(cell));
  }

  [[nodiscard]] Motion motion(std::uint64_t job, const std::vector<ArmId>& arms, double from,
                              double to) const {
    const Duration duration = from_seconds(std::abs(to - from) / kSpeed_m_s);
    std::vector<JointId> joints;
    for (const ArmId arm : arms) joints.push_back(cell->arm(arm).joints[0]);
    Segment segment{Duration{}, duration, {}};
    segment.coefficients.setZero(static_cast<Eigen::Index>(joints.size()), 6);
    segment.coefficients.col(0).setConstant(from);
    segment.coefficients.col(1).setConstant((to - from) / to_seconds(duration));
    return {StepId{JobId{job}},
            std::make_shared<const Trajectory>(joints, arms, std::vector<Segment>{segment}),
            {}};
  }
  // Moves to and fro `ways` times.
  [[nodiscard]] Motion shuttle(std::uint64_t job, ArmId arm, double from, double to,
                               int ways) const {
    const Duration takes = from_seconds(std::abs(to - from) / kSpeed_m_s);
    std::vector<Segment> segments;
    for (int way = 0; way < ways; ++way) {
      Segment& segment = segments.emplace_back(Segment{way * takes, takes, {}});
      segment.coefficients.setZero(1, 6);
      segment.coefficients(0, 0) = way % 2 == 0 ? from : to;
      segment.coefficients(0, 1) = (way % 2 == 0 ? 1.0 : -1.0) * (to - from) / to_seconds(takes);
    }
    return {StepId{JobId{job}},
            std::make_shared<const Trajectory>(std::vector{cell->arm(arm).joints[0]},
                                               std::vector{arm}, std::move(segments)),
            {}};
  }
  [[nodiscard]] Motion to_come(Motion motion) const {
    motion.to_come = true;
    return motion;
  }
  [[nodiscard]] Verdict judge() { return checker->judge(question); }

  CellPtr cell;
  std::optional<MotionChecker> checker;
  Question question{};
};

}  // namespace armloom::rails
