// Pairs that an SRDF disables between arms: skipped where proven out of reach, checked elsewhere.
#include "core/collision/scene/out_of_reach.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/geometry/capsule/segment_distance.h"
#include "core/model/kinematics.h"
#include "test/collision/busy_cell.h"
#include "test/model/arm_row.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

using Reason = SkippedPair::Reason;
using testing::Contains;
using testing::Not;
using testing::UnorderedElementsAre;

// Homes in which the arms of a row (test/model/arm_row.h) stand beside each other.
CellDescription row_of(int arms, const ScratchFolder& folder) {
  RobotDescription robot;
  robot.name = "row";
  robot.urdf = folder.write("row.urdf", test::arm_row_urdf(arms));
  robot.srdf = folder.write("row.srdf", test::arm_row_srdf(arms));
  for (int i = 0; i < arms; ++i) {
    const std::string name = "arm" + std::to_string(i);
    robot.arms.push_back({name, name, {1.5708, 0.0}, {}, {}});
  }
  CellDescription cell;
  cell.name = "row";
  cell.robots.push_back(robot);
  return cell;
}

TEST(ClaimedPairs, AreSkippedOnlyWhereTheCellFileAllowsThemOrTheyAreOutOfReach) {
  const ScratchFolder folder;
  CellDescription row = row_of(2, folder);
  row.allowed_collisions = {{"arm1_2_link", "arm0_2_link"}};
  EXPECT_THAT(busy::scene_of(build_or_fail(row))->skipped_pairs(),
              UnorderedElementsAre(SkippedPair{"arm0_1_link", "arm0_2_link", Reason::robot_files},
                                   SkippedPair{"arm1_1_link", "arm1_2_link", Reason::robot_files},
                                   SkippedPair{"arm0_2_link", "arm1_2_link", Reason::cell_file},
                                   SkippedPair{"post", "arm0_1_link", Reason::out_of_reach},
                                   SkippedPair{"far_post", "arm0_1_link", Reason::out_of_reach},
                                   SkippedPair{"far_post", "arm0_2_link", Reason::out_of_reach}));
}

TEST(ClaimedPairs, OfEightArmsAreProvenFromWhereTheyCannotReach) {
  const ScratchFolder folder;
  const PlanningScenePtr scene = busy::scene_of(build_or_fail(row_of(8, folder)));
  const auto skipped = scene->skipped_pairs();
  // Links reach 0.43 and 0.83 m, arms stand 0.6 m apart: all pairs of arms three places apart, the
  // first links of arms two places apart, and three pairs with the posts.
  EXPECT_EQ(std::ranges::count(skipped, Reason::out_of_reach, &SkippedPair::reason),
            15 * 4 + 6 + 3);
  const auto pair = [](const char* a, const char* b) {
    return SkippedPair{a, b, Reason::out_of_reach};
  };
  EXPECT_THAT(skipped, Contains(pair("arm0_2_link", "arm3_2_link")));
  EXPECT_THAT(skipped, Contains(pair("arm0_1_link", "arm2_1_link")));
  EXPECT_THAT(skipped, Not(Contains(pair("arm0_1_link", "arm2_2_link"))));
  EXPECT_THAT(skipped, Not(Contains(pair("arm3_1_link", "arm4_1_link"))));
  EXPECT_EQ(scene->cell().allowed.claimed_pairs.size(), 28U * 4 + 4);
}

TEST(ClaimedPairs, AreProvenByTheirJointLimitsWithinTheClearance) {
  const ScratchFolder folder;
  CellDescription row = row_of(2, folder);
  const auto skipped_with = [&](double lowest) {
    row.robots[0].arms[0].limits["arm0_1"].lower = lowest;
    return busy::scene_of(build_or_fail(row))->skipped_pairs();
  };
  const SkippedPair first{"arm0_1_link", "arm1_1_link", Reason::out_of_reach};
  EXPECT_THAT(skipped_with(0.3), Not(Contains(first)));
  // The link stays beside its side of the y axis: 0.15 m from where arm1 leans over to it.
  EXPECT_THAT(skipped_with(1.5), Contains(first));
  EXPECT_THAT(skipped_with(1.5),
              Not(Contains(SkippedPair{"arm0_1_link", "arm1_2_link", Reason::out_of_reach})));
  row.clearance_m = 0.2;
  EXPECT_THAT(skipped_with(1.5), Not(Contains(first)));
}

// Two arms with limits, sliding and following joints among them; all pairs between them claimed.
Cell claimed_cell(std::mt19937_64& random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Cell cell;
  for (const char* name : {"a", "b"}) {
    std::vector<Eigen::Vector3d> axes(3);
    for (Eigen::Vector3d& axis : axes) {
      axis = Eigen::Vector3d(between(-1, 1), between(-1, 1), between(-1, 1)).normalized();
    }
    Eigen::Isometry3d base = small::at_xyz(*name == 'a' ? 0.0 : between(0.5, 1.6), 0, 0);
    base.rotate(Eigen::AngleAxisd(between(-3, 3), axes[0]));
    small::add_robot(cell, name, base, axes, {between(0.15, 0.3), 0.03});
  }
  for (Joint& joint : cell.joints) {
    if (between(0, 1) < 0.2) continue;  // without limits
    joint.lower = between(-3, 0);
    joint.upper = joint.lower + between(0, 4);
  }
  for (Link& link : cell.links) {
    if (!link.driver) continue;
    link.offset = between(-1, 1);
    if (between(0, 1) < 0.3 && link.driver->index() % 3 != 0) {
      link.driver = JointId{link.driver->value() - 1};  // follows
      link.multiplier = between(-2, 2);
    }
    if (between(0, 1) < 0.3 && std::isfinite(cell.joint(*link.driver).upper)) {
      link.motion = JointKind::prismatic;
      link.multiplier *= 0.1;
      link.offset *= 0.1;
    }
  }
  for (std::uint32_t i = 0; i < cell.links.size(); ++i) {
    for (std::uint32_t j = i + 1; j < cell.links.size(); ++j) {
      const auto& a = cell.links[i].arm;
      const auto& b = cell.links[j].arm;
      if (a && b && a != b) cell.allowed.claimed_pairs[{LinkId{i}, LinkId{j}}] = "test.srdf:1";
    }
  }
  return cell;
}

double distance_of(const Cell& cell, const Configuration& q, const LinkPair& pair) {
  LinkPoses X_WL;
  forward_kinematics(cell, q, X_WL);
  const auto line = [&](LinkId id) {
    const Eigen::Isometry3d& X = X_WL[id.index()];
    const Eigen::Vector3d tip = cell.link(id).shapes.back().X_LS.translation();
    return CenteredSegment{X * Eigen::Vector3d(0.5 * tip), X.linear() * Eigen::Vector3d(0.5 * tip)};
  };
  return segment_segment_distance(line(pair.first), line(pair.second)) - 0.06;
}

// The smallest distance that a search from random configurations finds.
double closest(const Cell& cell, const LinkPair& pair, std::mt19937_64& random) {
  const auto position = [&](std::size_t j) {
    const double turn = 2.0 * small::kHalfTurn;
    const double lower = std::max(cell.joints[j].lower, -turn);
    const double upper = std::min(cell.joints[j].upper, turn);
    return std::uniform_real_distribution<double>(lower, upper)(random);
  };
  double smallest = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 20; ++start) {
    Configuration q(static_cast<Eigen::Index>(cell.joints.size()));
    for (std::size_t j = 0; j < cell.joints.size(); ++j) {
      q[static_cast<Eigen::Index>(j)] = position(j);
    }
    double found = distance_of(cell, q, pair);
    for (int step = 0; step < 150; ++step) {
      const std::size_t j = random() % cell.joints.size();
      Configuration other = q;
      double& value = other[static_cast<Eigen::Index>(j)];
      value = value + (position(j) - value) / static_cast<double>(1 + step / 15);
      const double distance = distance_of(cell, other, pair);
      if (distance >= found) continue;
      found = distance;
      q = other;
    }
    smallest = std::min(smallest, found);
  }
  return smallest;
}

TEST(ClaimedPairs, ThatAreProvenKeepTheClearanceInEveryConfiguration) {
  int proven = 0;
  int checked = 0;
  int near_proofs = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const CellPtr cell = small::shared(claimed_cell(random));
    const auto& out_of_reach = *busy::scene_of(cell)->bodies().out_of_reach;
    for (const auto& [pair, place] : cell->allowed.claimed_pairs) {
      const double distance = closest(*cell, pair, random);
      if (!out_of_reach.contains(pair)) {
        checked += 1;
        continue;
      }
      proven += 1;
      near_proofs += distance < 0.1 ? 1 : 0;
      EXPECT_GE(distance, cell->clearances.clearance_m)
          << "seed " << seed << ": " << cell->link(pair.first).name << " and "
          << cell->link(pair.second).name;
    }
  }
  EXPECT_GE(proven, 100);
  EXPECT_GE(checked, 100);
  EXPECT_GE(near_proofs, 10);
}

}  // namespace
}  // namespace armloom
