#include "core/collision/scene/out_of_reach.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/collision/scene/swept_link.h"
#include "core/geometry/capsule/segment_distance.h"
#include "core/model/kinematics.h"
#include "test/collision/busy_cell.h"
#include "test/model/arm_row.h"
#include "test/model/test_cells.h"

namespace armloom {

namespace {

using testing::Contains;
using testing::Not;
using testing::SizeIs;
using testing::UnorderedElementsAre;

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

using NamePair = std::pair<std::string, std::string>;
std::vector<NamePair> out_of_reach(const PlanningScenePtr& scene) {
  std::vector<NamePair> names;
  for (const auto& [a, b] : *scene->bodies().out_of_reach) {
    names.emplace_back(scene->cell().link(a).name, scene->cell().link(b).name);
  }
  return names;
}

TEST(ClaimedPairs, AreSkippedOnlyIfProvenOutOfReach) {
  const ScratchFolder folder;
  EXPECT_THAT(
      out_of_reach(busy::scene_of(build_or_fail(row_of(2, folder)))),
      UnorderedElementsAre(NamePair{"arm0_1_link", "post"}, NamePair{"arm0_1_link", "far_post"},
                           NamePair{"arm0_2_link", "far_post"}));
}

TEST(ClaimedPairs, AreSkippedForArmsTooFarApart) {
  const ScratchFolder folder;
  const PlanningScenePtr scene = busy::scene_of(build_or_fail(row_of(8, folder)));
  const auto skipped = out_of_reach(scene);
  // First links reach 0.43 m, second links 0.83 m, and arms are 0.6 m apart. Proven out of reach
  // are all links of arms three or more places apart, first links of arms two places apart, and
  // three pairs with the posts.
  EXPECT_THAT(skipped, SizeIs(15 * 4 + 6 + 3));
  EXPECT_THAT(skipped, Contains(NamePair("arm0_2_link", "arm3_2_link")));
  EXPECT_THAT(skipped, Contains(NamePair("arm0_1_link", "arm2_1_link")));
  EXPECT_THAT(skipped, Not(Contains(NamePair("arm0_1_link", "arm2_2_link"))));
  EXPECT_THAT(skipped, Not(Contains(NamePair("arm3_1_link", "arm4_1_link"))));
  EXPECT_EQ(scene->cell().allowed.claimed_pairs.size(), 28U * 4 + 4);
}

TEST(ClaimedPairs, AreProvenFromJointLimitsAndClearance) {
  const ScratchFolder folder;
  CellDescription row = row_of(2, folder);
  const auto skipped_with = [&](double lowest) {
    row.robots[0].arms[0].limits["arm0_1"].lower = lowest;
    return out_of_reach(busy::scene_of(build_or_fail(row)));
  };
  const NamePair first{"arm0_1_link", "arm1_1_link"};
  EXPECT_THAT(skipped_with(0.3), Not(Contains(first)));
  // Between these joint limits arm0's first link stays 0.15 m from the nearest position of arm1's
  // first link.
  EXPECT_THAT(skipped_with(1.5), Contains(first));
  EXPECT_THAT(skipped_with(1.5), Not(Contains(NamePair{"arm0_1_link", "arm1_2_link"})));
  row.clearance_m = 0.2;
  EXPECT_THAT(skipped_with(1.5), Not(Contains(first)));
}

// Returns two arms with prismatic and mimic joints and limits; all pairs between them are claimed.
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
    Eigen::Isometry3d base = small::at_xyz(*name == 'a' ? 0.0 : between(0.3, 1.1), 0, 0);
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
      link.driver = JointId{link.driver->value() - 1};  // mimic joint
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

CenteredSegment line_of(const Cell& cell, const Configuration& q, LinkId link) {
  LinkPoses X_WL;
  forward_kinematics(cell, q, X_WL);
  const Eigen::Isometry3d& X = X_WL[link.index()];
  const Eigen::Vector3d tip = cell.link(link).shapes.back().X_LS.translation();
  return {X * Eigen::Vector3d(0.5 * tip), X.linear() * Eigen::Vector3d(0.5 * tip)};
}

double distance_of(const Cell& cell, const Configuration& q, const LinkPair& pair) {
  return segment_segment_distance(line_of(cell, q, pair.first), line_of(cell, q, pair.second)) -
         0.06;
}

double closest(const Cell& cell, const LinkPair& pair, std::mt19937_64& random) {
  const auto position = [&](std::size_t j) {
    const double turn = 2.0 * small::kHalfTurn;
    const double lower = std::max(cell.joints[j].lower, -turn);
    const double upper = std::min(cell.joints[j].upper, turn);
    return std::uniform_real_distribution<double>(lower, upper)(random);
  };
  double smallest = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 12; ++start) {
    Configuration q(static_cast<Eigen::Index>(cell.joints.size()));
    for (std::size_t j = 0; j < cell.joints.size(); ++j) {
      q[static_cast<Eigen::Index>(j)] = position(j);
    }
    double found = distance_of(cell, q, pair);
    for (int step = 0; step < 120; ++step) {
      const std::size_t j = random() % cell.joints.size();
      Configuration other = q;
      double& value = other[static_cast<Eigen::Index>(j)];
      value = value + (position(j) - value) / static_cast<double>(1 + step / 12);
      const double distance = distance_of(cell, other, pair);
      if (distance >= found) continue;
      found = distance;
      q = other;
    }
    smallest = std::min(smallest, found);
  }
  return smallest;
}

std::vector<JointId> drivers_of(const Cell& cell, LinkId link) {
  std::vector<JointId> drivers;
  for (auto next = std::optional(link); next; next = cell.link(*next).parent) {
    const auto& driver = cell.link(*next).driver;
    if (!driver) continue;
    std::erase(drivers, *driver);
    drivers.insert(drivers.begin(), *driver);
  }
  return drivers;
}

TEST(SweptLink, EveryPartContainsTheLinkAtAllItsJointValues) {
  double tightest = 0.0;  // largest share of the bound that a link really moved
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const CellPtr cell = small::shared(claimed_cell(random));
    const LinkId link{static_cast<std::uint32_t>(cell->links.size() - 1)};
    SweptLink swept(busy::scene_of(cell)->bodies(), link, 0.0);
    const auto drivers = drivers_of(*cell, link);
    std::size_t number = 0;
    for (int depth = 0; depth < 12; ++depth) {
      const SweptLink::Part part = swept.part(number);
      ASSERT_EQ(part.intervals.size(), drivers.size());
      const auto line_at = [&](const auto& share) {
        Configuration q = Configuration::Zero(static_cast<Eigen::Index>(cell->joints.size()));
        for (std::size_t i = 0; i < drivers.size(); ++i) {
          q[static_cast<Eigen::Index>(drivers[i].index())] =
              part.intervals[i].center + share() * part.intervals[i].half;
        }
        return line_of(*cell, q, link);
      };
      const CenteredSegment middle = line_at([] { return 0.0; });
      for (int sample = 0; sample < 100; ++sample) {
        const CenteredSegment line = line_at([&] {
          return std::clamp(std::uniform_real_distribution(-2.0, 2.0)(random), -1.0, 1.0);
        });
        for (const double end : {-1.0, 1.0}) {
          const Eigen::Vector3d p = line.center + end * line.half;
          const double moved_m = (p - middle.center - end * middle.half).norm();
          ASSERT_LE(moved_m, part.motion_m + 1e-9) << "seed " << seed << ", depth " << depth;
          ASSERT_LE((p - part.ball.center).norm() + 0.03, part.ball.radius_m + 1e-9)
              << "seed " << seed << ", depth " << depth;
          tightest = std::max(tightest, moved_m / part.motion_m);
        }
      }
      const auto half = swept.halve(number);
      if (!half) break;
      number = *half + random() % 2;
    }
  }
  EXPECT_GT(tightest, 0.7);
}

TEST(ClaimedPairs, ProvenPairsKeepTheClearanceInEveryConfiguration) {
  int proven = 0;
  int checked = 0;
  int near_proofs = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    const CellPtr cell = small::shared(claimed_cell(random));
    const auto& out_of_reach = *busy::scene_of(cell)->bodies().out_of_reach;
    for (const auto& [pair, place] : cell->allowed.claimed_pairs) {
      if (!out_of_reach.contains(pair)) {
        checked += 1;
        continue;
      }
      proven += 1;
      const double distance = closest(*cell, pair, random);
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
