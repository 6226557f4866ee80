#include <gtest/gtest.h>

#include "core/collision/check/motion_checker.h"
#include "core/collision/state/clearance_query.h"
#include "test/collision/holding_cell.h"
#include "test/collision/scaled_query.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;
using namespace holding;

TEST(AttachedObjects, CheckerDistancesMatchBruteForce) {
  Holding h;
  small::ScaledQuery checker(h.scene);
  const double limit_m = 0.1;
  const double self_limit_m =
      limit_m * h.cell->clearances.self_clearance_m / h.cell->clearances.clearance_m;
  std::vector<NearPair> near;
  int close = 0;
  int contacts = 0;
  for (int i = 0; i < 150; ++i) {
    const Configuration q = h.random_configuration();
    near = checker.near(q, limit_m);
    std::map<NamePair, double> seen;
    for (const NearPair& pair : near) {
      const Proximity proximity = checker.describe(pair);
      if (!proximity.held_a && !proximity.held_b) continue;
      seen[names(proximity.body_a, proximity.body_b)] = pair.clearance_m;
    }
    for (const auto& [pair, distance_m] : brute_force(h, q)) {
      const auto own = [&](const char* arm, const char* one, const char* two) {
        const auto belongs = [&](const std::string& name) {
          const bool mount = name.ends_with("panda_link0");  // scene
          return (name.starts_with(arm) && !mount) || name == one || name == two;
        };
        return belongs(pair.first) && belongs(pair.second);
      };
      const bool self = own("left", "crate", "rod") || own("right", "bracket", "bracket");
      const double limit = self ? self_limit_m : limit_m;
      const auto entry = seen.find(pair);
      const double checked = entry == seen.end() ? limit : entry->second;
      EXPECT_NEAR(std::max(0.0, checked), std::min(distance_m, limit), 1e-6)
          << pair.first << " " << pair.second << " in state " << i;
      close += distance_m > 0.0 && distance_m < limit ? 1 : 0;
      contacts += distance_m <= 0.0 ? 1 : 0;
      if (entry != seen.end()) seen.erase(entry);
    }
    EXPECT_TRUE(seen.empty()) << seen.begin()->first.first << " " << seen.begin()->first.second;
  }
  EXPECT_GT(close, 100);
  EXPECT_GT(contacts, 100);
}

// The limits are just above and just below the distance of the attached object. Only a kernel that
// includes the object decides both correctly.
TEST(AttachedObjects, KernelsDecideByTheAttachedObjectAlone) {
  Holding h;
  int alone = 0;
  for (int i = 0; i < 200; ++i) {
    const Configuration q = h.random_configuration();
    double closest_m = 1e9;
    for (const auto& [pair, d] : brute_force(h, q)) closest_m = std::min(closest_m, d);
    if (closest_m < 1e-4) continue;
    const Configuration* state = &q;
    const PairLimits above{closest_m + 1e-5, closest_m + 1e-5};
    const PairLimits below{closest_m - 1e-5, closest_m - 1e-5};
    if (ClearanceQuery(h.bare, above).too_close({&state, 1}) != 0) continue;
    EXPECT_EQ(ClearanceQuery(h.scene, above).too_close({&state, 1}), 1U);
    EXPECT_EQ(ClearanceQuery(h.scene, below).too_close({&state, 1}), 0U);
    ++alone;
  }
  EXPECT_GT(alone, 3);
}

TEST(AttachedObjects, KeepTheClearanceAlongSweptMotions) {
  Holding h;
  MotionChecker motion_checker(h.scene);
  MotionChecker of_bare(h.bare);
  small::ScaledQuery checker(h.scene);
  int free = 0;
  int because_held = 0;
  const Configuration home = h.cell->home();
  for (int i = 0; i < 60; ++i) {
    const auto towards = [&](ArmId arm, const Configuration& to, double share) {
      std::vector<double> values;
      for (const JointId joint : h.cell->arm(arm).joints) {
        const auto k = static_cast<Eigen::Index>(joint.index());
        values.push_back(home[k] + share * (to[k] - home[k]));
      }
      return values;
    };
    const Configuration to = h.random_configuration();
    const Motion candidate{StepId{JobId{1}},
                           small::sweep(*h.cell, {ArmId{0}}, towards(ArmId{0}, to, 0.0),
                                        towards(ArmId{0}, to, 0.3), 2s),
                           0s};
    const Motion other{StepId{JobId{2}},
                       small::sweep(*h.cell, {ArmId{1}}, towards(ArmId{1}, to, 0.0),
                                    towards(ArmId{1}, to, 0.3), 3s),
                       500ms};
    const Question question{1, at(0s), {candidate}, {other}, home, Swept{0.0}};
    const Verdict verdict = motion_checker.judge(question);
    if (verdict.kind != Verdict::Kind::free) {
      because_held += of_bare.judge(question).kind == Verdict::Kind::free ? 1 : 0;
      continue;
    }
    ++free;
    Configuration q = home;
    Eigen::VectorXd positions;
    for (Duration t = 0s; t <= 2500ms; t += 1ms) {
      for (const Motion& motion : {candidate, other}) {
        motion.trajectory->sample_positions(
            std::min(motion.progress + t, motion.trajectory->duration()), positions);
        for (std::size_t k = 0; k < motion.trajectory->joints().size(); ++k) {
          q[static_cast<Eigen::Index>(motion.trajectory->joints()[k].index())] =
              positions[static_cast<Eigen::Index>(k)];
        }
      }
      const auto near = checker.first_closer_than(q, h.cell->clearances.clearance_m - 1e-6,
                                                  std::vector<bool>{true, false});
      ASSERT_FALSE(near.has_value())
          << near->body_a << " " << near->body_b << " at " << to_seconds(t) << " s of pair " << i;
    }
  }
  EXPECT_GT(free, 5);
  EXPECT_GT(because_held, 5);
}

}  // namespace
}  // namespace armloom
