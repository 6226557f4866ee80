#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "core/model/kinematics.h"
#include "test/collision/busy_cell.h"
#include "test/collision/scaled_query.h"
#include "test/geometry/reference_distance.h"

namespace armloom {
namespace {

using namespace busy;

using NamePair = std::pair<std::string, std::string>;
NamePair names(const std::string& a, const std::string& b) { return std::minmax(a, b); }

double limit_for(const Cell& cell, const NamePair& pair) {
  if (pair.first == "left_post" || pair.second == "left_post") return cell.clearances.clearance_m;
  const bool self = (pair.first.starts_with("left") && pair.second.starts_with("left")) ||
                    (pair.first.starts_with("right") && pair.second.starts_with("right"));
  return self ? cell.clearances.self_clearance_m : cell.clearances.clearance_m;
}

reference::Convex placed(const PlacedShape& shape, const Eigen::Isometry3d& X_WP) {
  using Kind = reference::Convex::Kind;
  const Eigen::Isometry3d X_WS = X_WP * shape.X_LS;
  if (const auto* ball = std::get_if<Sphere>(&shape.shape)) {
    return {Kind::capsule, {}, ball->radius_m, 0.0, X_WS};
  }
  if (const auto* tube = std::get_if<Cylinder>(&shape.shape)) {
    return {Kind::cylinder, {}, tube->radius_m, 0.5 * tube->length_m, X_WS};
  }
  return {Kind::box, 0.5 * std::get<Box>(shape.shape).size_m, 0.0, 0.0, X_WS};
}

// Computes the distance of every relevant pair, shape by shape, in closed form
// (reference_distance.h).
std::map<NamePair, reference::Bracket> brute_force(const Cell& cell, const Configuration& q) {
  struct Solid {
    std::string name;
    std::optional<ArmId> arm;
    std::size_t index;
    bool object;
    std::vector<PlacedShape> shapes;
    Eigen::Isometry3d X_WP;
  };
  LinkPoses X_WL;
  forward_kinematics(cell, q, X_WL);
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < cell.links.size(); ++i) {
    const Link& link = cell.links[i];
    solids.push_back({link.name, link.arm, i, false, link.shapes, X_WL[i]});
  }
  for (const CollisionObject& o : cell.objects) {
    solids.push_back({o.name, {}, 0, true, std::vector<PlacedShape>(1, {o.shape}), o.X_WO});
  }
  std::map<NamePair, reference::Bracket> found;
  for (const Solid& a : solids) {
    for (const Solid& b : solids) {
      if (&a >= &b || a.object || (!a.arm && !b.arm)) continue;
      const LinkId id_a{static_cast<std::uint32_t>(a.index)};
      const LinkId id_b{static_cast<std::uint32_t>(b.index)};
      if (b.object ? cell.allowed.link_objects.contains({id_a, b.name})
                   : cell.allowed.allows(id_a, id_b)) {
        continue;
      }
      reference::Bracket smallest{1e9, 1e9};
      for (const PlacedShape& x : a.shapes) {
        for (const PlacedShape& y : b.shapes) {
          const auto apart = reference::distance(placed(x, a.X_WP), placed(y, b.X_WP), 2000);
          smallest.lower = std::min(smallest.lower, apart.lower);
          smallest.upper = std::min(smallest.upper, apart.upper);
        }
      }
      if (smallest.upper < 1e9) found[names(a.name, b.name)] = smallest;
    }
  }
  return found;
}

Configuration random_configuration(const Cell& cell, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(-2.5, 2.5);
  Configuration q(static_cast<Eigen::Index>(cell.joints.size()));
  for (double& value : q) value = angle(random);
  return q;
}

constexpr double kRounding_m = 1e-6;

void expect_within(const reference::Bracket& distance, double clearance_m) {
  EXPECT_GE(std::max(0.0, clearance_m), std::max(0.0, distance.lower) - kRounding_m);
  EXPECT_LE(std::max(0.0, clearance_m), distance.upper + kRounding_m);
}

TEST(ClearanceQuery, FindsEveryPairThatBruteForceFinds) {
  const CellPtr cell = small::shared(busy_cell());
  small::ScaledQuery checker(scene_of(cell));
  std::mt19937_64 random(99);
  std::vector<NearPair> near;
  std::size_t found = 0, open = 0;
  for (int i = 0; i < 2500; ++i) {
    const Configuration q = random_configuration(*cell, random);
    near = checker.near(q, cell->clearances.clearance_m);
    std::map<NamePair, double> seen;
    for (const NearPair& pair : near) {
      const Proximity p = checker.describe(pair);
      seen[names(p.body_a, p.body_b)] = p.clearance_m;
    }
    for (const auto& [pair, distance] : brute_force(*cell, q)) {
      const auto at = seen.find(pair);
      const double limit_m = limit_for(*cell, pair);
      if (distance.upper < limit_m - kRounding_m) {
        ASSERT_NE(at, seen.end()) << i << ": " << pair.first << " and " << pair.second;
        expect_within(distance, at->second);
        ++found;
      } else if (distance.lower > limit_m + kRounding_m) {
        EXPECT_EQ(at, seen.end()) << i << ": " << pair.first << " and " << pair.second;
      } else {
        ++open;
      }
    }
  }
  EXPECT_GT(found, 1000U);
  EXPECT_LT(open, found / 100) << "so many the closed forms could not say";
}

TEST(ClearanceQuery, FirstCloserThanIsTheFirstInSceneOrder) {
  const CellPtr cell = small::shared(busy_cell());
  small::ScaledQuery checker(scene_of(cell));
  std::mt19937_64 random(5);
  std::vector<NearPair> near;
  std::size_t found = 0;
  for (int i = 0; i < 500; ++i) {
    const Configuration q = random_configuration(*cell, random);
    const auto truly = brute_force(*cell, q);
    for (const std::vector<bool>& arms : {std::vector{true, true}, {true, false}, {false, true}}) {
      near = checker.near(q, 0.02, arms);
      const auto first = checker.first_closer_than(q, 0.02, arms);
      ASSERT_EQ(first.has_value(), !near.empty());
      if (!first) continue;
      ++found;
      expect_within(truly.at(names(first->body_a, first->body_b)), first->clearance_m);
      const Proximity expected = checker.describe(near.front());
      EXPECT_EQ(first->body_a, expected.body_a);
      EXPECT_EQ(first->body_b, expected.body_b);
      EXPECT_EQ(first->clearance_m, expected.clearance_m);
      EXPECT_TRUE((first->arm_a && arms[first->arm_a->index()]) ||
                  (first->arm_b && arms[first->arm_b->index()]));
    }
  }
  EXPECT_GT(found, 300U);
}

TEST(ClearanceQuery, ClosestApartIsTheSmallestOverAllPairs) {
  const CellPtr cell = small::shared(busy_cell());
  small::ScaledQuery checker(scene_of(cell));
  std::mt19937_64 random(17);
  int within = 0;
  for (int i = 0; i < 500; ++i) {
    const Configuration q = random_configuration(*cell, random);
    reference::Bracket smallest{1e9, 1e9};
    for (const auto& [pair, distance] : brute_force(*cell, q)) {
      if (pair.first.starts_with("left_link") && pair.second.starts_with("right")) {
        smallest = {std::min(smallest.lower, distance.lower),
                    std::min(smallest.upper, distance.upper)};
      }
    }
    auto closest = checker.closest_apart(q, 0.3).apart;
    std::erase_if(closest, [](const Proximity& pair) { return !pair.arm_b; });
    if (smallest.lower > 0.3 + kRounding_m) {
      EXPECT_TRUE(closest.empty());
    } else if (smallest.upper < 0.3 - kRounding_m) {
      ASSERT_EQ(closest.size(), 1U);
      expect_within(smallest, closest[0].clearance_m);
      ++within;
    }
  }
  EXPECT_GT(within, 100);
}

TEST(ClearanceQuery, AllCloserThanListsTheClosestOfEachCounterpart) {
  Cell cell;
  const ArmId left =
      small::add_robot(cell, "left", small::at_xyz(0, 0, 0), {kZ, kZ, kZ}, {0.3, 0.05});
  const ArmId right = small::add_robot(cell, "right", small::at_xyz(0, 2, 0), {kZ}, {0.3, 0.05});
  cell.objects.push_back({"near", Sphere{0.1}, small::at_xyz(0.15, 0, 0.155)});
  cell.objects.push_back({"nearer", Sphere{0.1}, small::at_xyz(0.15, 0, -0.152)});
  small::ScaledQuery checker(scene_of(small::shared(cell)));
  Configuration q = cell.home();
  q[2] = 3.1;
  q[1] = 3.1;  // folded twice: link3 touches link1
  const auto found = checker.all_closer_than(q, 0.01);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].body_b, "nearer");
  EXPECT_TRUE(found[0].object_b);
  EXPECT_NEAR(found[0].clearance_m, 0.002, 1e-9);
  EXPECT_EQ(found[0].limit_m, 0.01);
  EXPECT_EQ(found[1].body_a, "left_link1");
  EXPECT_EQ(found[1].body_b, "left_link3");
  EXPECT_EQ(found[1].arm_b, left);
  EXPECT_NE(found[1].arm_a, right);
  EXPECT_NEAR(found[1].limit_m, 0.0025, 1e-12);  // self clearance of 5 mm, scaled by 10 mm / 20 mm
}

TEST(ClearanceQuery, AppliesSelfClearanceToAnArmsOwnLinks) {
  Cell cell;
  cell.clearances.clearance_m = 0.02;
  cell.clearances.self_clearance_m = 0.005;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ, kZ, kZ}, {0.3, 0.05});
  Configuration q(3);
  q << 0.0, small::kHalfTurn - std::asin(0.11 / 0.3), 0.0;
  small::ScaledQuery checker(scene_of(small::shared(cell)));
  EXPECT_TRUE(checker.all_closer_than(q, 0.02).empty());
  cell.clearances.self_clearance_m = 0.012;
  small::ScaledQuery stricter(scene_of(small::shared(cell)));
  const auto found = stricter.all_closer_than(q, 0.02);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].clearance_m, 0.01, 1e-9);
  EXPECT_EQ(found[0].limit_m, 0.012);
}

TEST(ClearanceQuery, ReportsContactEvenAtZeroClearance) {
  Cell cell = busy_cell();
  cell.clearances.clearance_m = 0.0;
  cell.clearances.self_clearance_m = 0.0;
  const CellPtr shared = small::shared(cell);
  small::ScaledQuery checker(scene_of(shared));
  std::mt19937_64 random(3);
  int contacts = 0;
  for (int i = 0; i < 300; ++i) {
    const Configuration q = random_configuration(*shared, random);
    reference::Bracket smallest{1.0, 1.0};
    for (const auto& [pair, distance] : brute_force(*shared, q)) {
      smallest = {std::min(smallest.lower, distance.lower),
                  std::min(smallest.upper, distance.upper)};
    }
    const bool found = checker.first_closer_than(q, 0.0, {true, true}).has_value();
    if (found) {
      EXPECT_LE(smallest.lower, kRounding_m) << i;
    } else {
      EXPECT_GT(smallest.upper, 0.0) << i;
    }
    contacts += found ? 1 : 0;
  }
  EXPECT_GT(contacts, 50);
}

}  // namespace
}  // namespace armloom
