#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/audit/audit.h"
#include "core/audit/audited_cell.h"
#include "core/collision/scene/scene_bodies.h"
#include "core/collision/state/check_home.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"
#include "test/model/test_cells.h"

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr double kHorizon_m = 0.02;

struct Pandas {
  CellPtr cell = build_or_fail(two_pandas_description());
  PlanningScenePtr scene = *PlanningScene::build(cell);
  small::ScaledQuery checker{scene};
  std::mt19937_64 random{2024};

  Configuration random_configuration() {
    Configuration q = cell->home();
    for (const Arm& arm : cell->arms) {
      for (const JointId id : arm.joints) {
        const Joint& joint = cell->joint(id);
        std::uniform_real_distribution<double> angle(joint.lower, joint.upper);
        q[static_cast<Eigen::Index>(id.index())] = angle(random);
      }
    }
    return q;
  }
};

TEST(TwoPandas, ConsistOfCapsulesAfterMerging) {
  const Pandas pandas;
  const auto& bodies = pandas.scene->bodies();
  std::size_t boxes = 0;
  for (const ConvexShape& body : bodies.shapes) {
    EXPECT_NE(body.kind, ConvexShapeKind::cylinder);
    boxes += body.kind == ConvexShapeKind::box ? 1U : 0U;
  }
  EXPECT_EQ(boxes, 1U);  // the table
}

TEST(TwoPandas, AreCollisionFreeAtHome) {
  const Pandas pandas;
  for (const Problem& problem : check_home(pandas.scene)) ADD_FAILURE() << problem.detail;
}

struct Audited {
  bool contact = false;
  double smallest_m = kHorizon_m;  // between arms or to the scene
};

Audited audited_at(AuditedCell& audited, const Cell& cell, const Configuration& q) {
  Audited found;
  audited.move_to(cell, q);
  for (AuditedPair& pair : audited.pairs()) {
    const double matters_m = pair.contact_only ? 0.0 : kHorizon_m;
    if (audited.at_least(pair) > matters_m) continue;
    const double distance_m = audited.look(pair, matters_m);
    found.contact = found.contact || distance_m <= 0.0;
    if (!pair.contact_only) found.smallest_m = std::min(found.smallest_m, distance_m);
  }
  return found;
}

// The audit uses no capsules, filters or groups.
TEST(TwoPandas, CheckerAndAuditAgreeOnRandomStates) {
  Pandas pandas;
  AuditedCell audited = AuditedCell::build(*pandas.cell).value();
  std::vector<NearPair> near;
  int contacts = 0;
  int free = 0;
  for (int i = 0; i < 2000; ++i) {
    const Configuration q = pandas.random_configuration();
    near = pandas.checker.near(q, kHorizon_m);
    double smallest = kHorizon_m;
    bool contact = false;
    for (const NearPair& pair : near) {
      contact = contact || pair.clearance_m <= 0.0;
      if (!pandas.checker.is_self(pair.pair)) smallest = std::min(smallest, pair.clearance_m);
    }
    const Audited found = audited_at(audited, *pandas.cell, q);
    EXPECT_EQ(found.contact, contact) << "state " << i;
    EXPECT_NEAR(found.smallest_m, std::max(0.0, smallest), 1e-6) << "state " << i;
    if (i % 20 == 0) {  // the same state, audited as a recording
      const auto report = audit(*pandas.cell, {{at(0s), q}}, 1ms);
      ASSERT_TRUE(report.has_value());
      EXPECT_EQ(report->first_contact.has_value(), contact) << "state " << i;
      EXPECT_NEAR(std::min(kHorizon_m, report->smallest_clearance->distance_m), found.smallest_m,
                  1e-6)
          << "state " << i;
    }
    (contact ? contacts : free) += 1;
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(free, 100);
}

}  // namespace
}  // namespace armloom
