#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "core/audit/audit.h"
#include "core/audit/audited_cell.h"
#include "core/collision/check/timed_discrete_check.h"
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

std::vector<double> of_arm(const Cell& cell, const Configuration& q, ArmId arm) {
  std::vector<double> values;
  for (const JointId joint : cell.arm(arm).joints) {
    values.push_back(q[static_cast<Eigen::Index>(joint.index())]);
  }
  return values;
}

TEST(TwoPandas, AreAllCapsulesOnceMerged) {
  const Pandas pandas;
  const auto& bodies = pandas.scene->bodies();
  std::size_t boxes = 0;
  for (const ConvexShape& body : bodies.shapes) {
    EXPECT_NE(body.kind, ConvexShapeKind::cylinder);
    boxes += body.kind == ConvexShapeKind::box ? 1U : 0U;
  }
  EXPECT_EQ(boxes, 1U);  // the table
}

TEST(TwoPandas, StandFreeAtHome) {
  const Pandas pandas;
  for (const Problem& problem : check_home(pandas.scene)) ADD_FAILURE() << problem.detail;
}

struct Audited {
  bool contact = false;
  double smallest_m = kHorizon_m;  // of what arms keep from others; at most the horizon
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

// The audit knows no capsule, no filter and no group: one FCL object for each URDF element.
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
    if (i % 20 == 0) {  // what a recording's audit makes of it
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

// What judge calls free keeps the clearance at its instants, as the audit sees them; what it calls
// a conflict with the other arm or the table does not.
TEST(TwoPandas, AuditConfirmsWhatIsJudged) {
  Pandas pandas;
  const ArmId left{0};
  const ArmId right{1};
  int free = 0;
  int conflicts = 0;
  for (int i = 0; i < 150; ++i) {
    const Configuration from = pandas.cell->home();
    // two of three stay near home: else nearly all hit the table
    const double share = i % 3 == 0 ? 1.0 : 0.3;
    const Configuration to = from + share * (pandas.random_configuration() - from);
    const auto move = [&](ArmId arm, Duration duration) {
      return small::sweep(*pandas.cell, {arm}, of_arm(*pandas.cell, from, arm),
                          of_arm(*pandas.cell, to, arm), duration);
    };
    const Question question{1,
                            at(0s),
                            {{JobId{1}, move(left, 2s), 0s}},
                            {{JobId{2}, move(right, 3s), 500ms}},
                            from,
                            TimedDiscrete{20ms}};
    const Verdict verdict = timed_discrete_check(question, pandas.checker);
    std::vector<RecordedState> states;
    Eigen::VectorXd positions;
    for (std::uint64_t k = 0; k < verdict.evaluations; ++k) {
      const Duration t = std::min<Duration>(20ms * k, 2500ms);
      states.push_back({at(t), from});
      for (const Motion& motion : {question.candidates[0], question.others[0]}) {
        motion.trajectory->sample_positions(motion.progress + t, positions);
        const auto& joints = motion.trajectory->joints();
        for (std::size_t j = 0; j < joints.size(); ++j) {
          states.back().q[static_cast<Eigen::Index>(joints[j].index())] =
              positions[static_cast<Eigen::Index>(j)];
        }
      }
    }
    if (verdict.kind == Verdict::Kind::conflict) {
      ++conflicts;
      const Proximity& seen = verdict.conflicts[0].proximity;
      EXPECT_LT(seen.clearance_m, pandas.cell->clearances.clearance_m);
      if (verdict.conflicts[0].with == Conflict::With::self) continue;
      const auto report = audit(*pandas.cell, {states.back()}, 20ms);
      EXPECT_LE(report->smallest_clearance->distance_m, std::max(0.0, seen.clearance_m) + 1e-6);
      continue;
    }
    ++free;
    // The right arm against table and itself is not the question: the left arm's pairs are.
    const std::vector<bool> of_left{true, false};
    for (const RecordedState& state : states) {
      EXPECT_FALSE(pandas.checker.first_closer_than(state.q, 0.02 - 1e-9, of_left).has_value());
    }
    const auto report = audit(*pandas.cell, states, 20ms);
    if (report->smallest_clearance->body_a.starts_with("left")) {
      EXPECT_GE(report->smallest_clearance->distance_m, 0.02 - 1e-6);
    }
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(conflicts, 20);
}

}  // namespace
}  // namespace armloom
