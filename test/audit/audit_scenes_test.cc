// Held objects, and objects that change, in the crossing cell: ball x slides along x and ball y
// along y, both with a radius of 0.1 m.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/audit/audit.h"
#include "core/audit/audited_cell.h"
#include "test/collision/small_cell.h"
#include "test/scenarios/crossing.h"

namespace armloom {
namespace {

using ::testing::UnorderedElementsAre;

constexpr double kBall_m = 0.1;
constexpr double kPart_m = 0.03;

struct Crossed {
  CellPtr cell = build_cell(crossing_description()).value();
  LinkId x = *cell->find_link("x_ball");
  LinkId y = *cell->find_link("y_ball");
};

CollisionObject ball(const std::string& name, const Eigen::Vector3d& p_WO,
                     double radius_m = kPart_m) {
  CollisionObject object{.name = name, .shape = Sphere{radius_m}};
  object.X_WO.translation() = p_WO;
  return object;
}
CollisionObject part_at(double x, double y, double z = 0.0) { return ball("part", {x, y, z}); }

Attachment held(CollisionObject object, LinkId link, const Eigen::Vector3d& p_LO) {
  Attachment held{.object = std::move(object), .link = link, .X_LO = {}, .touch = {}};
  held.X_LO = Eigen::Isometry3d(Eigen::Translation3d(p_LO));
  return held;
}
// The part in front of ball x.
Attachment held_part(const Crossed& in) {
  return held(part_at(9, 9), in.x, {kBall_m + kPart_m, 0, 0});
}

using Path = std::vector<std::pair<Duration, Eigen::Vector2d>>;
// Returns the positions of both sliders, every millisecond.
std::vector<RecordedState> states_of(const Path& path) {
  std::vector<RecordedState> states{{at(path[0].first), path[0].second}};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto& [from, q_from] = path[i - 1];
    const auto& [to, q_to] = path[i];
    for (Duration t = from + 1ms; t <= to; t += 1ms) {
      const double share = to_seconds(t - from) / to_seconds(to - from);
      states.push_back({at(t), q_from + share * (q_to - q_from)});
    }
  }
  return states;
}

AuditReport report_of(const Crossed& in, const Path& path,
                      const std::vector<RecordedScene>& scenes) {
  return audit(*in.cell, states_of(path), 1ms, scenes).value();
}

std::vector<std::string> bodies_of(const AuditFinding& finding) {
  return {finding.body_a, finding.body_b};
}

TEST(AuditScenes, MovesAHeldObjectWithItsLink) {
  const Crossed in;
  const std::vector<RecordedScene> scenes{{at(0ms), {}, {held_part(in)}}};
  // Ball x alone would stay 0.08 m away from ball y.
  const AuditReport near = report_of(in, {{0ms, {-1, 0}}, {720ms, {-0.28, 0}}}, scenes);
  EXPECT_FALSE(near.first_contact.has_value());
  EXPECT_NEAR(near.smallest_clearance->distance_m, 0.02, 1e-4);
  EXPECT_EQ(near.smallest_clearance->time, at(720ms));

  const Path further{{0ms, {-1, 0}}, {780ms, {-0.22, 0}}};
  const AuditReport met = report_of(in, further, scenes);
  ASSERT_TRUE(met.first_contact.has_value());
  EXPECT_THAT(bodies_of(*met.first_contact), UnorderedElementsAre("y_ball", "part"));
  EXPECT_NEAR(to_seconds(met.first_contact->time), 0.74, 0.0011);
  EXPECT_FALSE(report_of(in, further, {}).first_contact.has_value());
}

TEST(AuditScenes, FindsHeldObjectsThatMeet) {
  const Crossed in;
  const Attachment other = held(ball("other", {9, 9, 9}), in.y, {0.2, 0.05, 0});
  const Path path{{0ms, {-1, -0.25}}, {1s, {-0.2, -0.25}}};
  const AuditReport report = report_of(in, path, {{at(0ms), {}, {held_part(in), other}}});
  ASSERT_TRUE(report.first_contact.has_value());
  EXPECT_THAT(bodies_of(*report.first_contact), UnorderedElementsAre("part", "other"));
  EXPECT_FALSE(report_of(in, path, {{at(0ms), {}, {held_part(in)}}}).first_contact.has_value());
}

TEST(AuditScenes, FindsAHeldObjectAtAnObjectOfTheScene) {
  const Crossed in;
  const CollisionObject post = ball("post", {0.5, 0, 0});
  const Path path{{0ms, {-1, -1}}, {1s, {0, -1}}, {2s, {0.4, -1}}};
  const AuditReport report = report_of(in, path, {{at(0ms), {post}, {held_part(in)}}});
  ASSERT_TRUE(report.first_contact.has_value());
  EXPECT_THAT(bodies_of(*report.first_contact), UnorderedElementsAre("post", "part"));
}

TEST(AuditScenes, FindsAnObjectOnlyWhereItIs) {
  Cell cell = *Crossed{}.cell;
  cell.objects.push_back(part_at(0, 0.5));
  const Crossed in{std::make_shared<const Cell>(cell)};
  const Path path{{0ms, {-1, -1}}, {2s, {-1, 1}}};  // ball y passes (0, 0.5)
  const AuditReport still = report_of(in, path, {});
  ASSERT_TRUE(still.first_contact.has_value());
  EXPECT_NEAR(to_seconds(still.first_contact->time), 1.37, 0.0011);
  // The cell's object holds until the first scene.
  const RecordedScene attached{at(1s), {}, {held_part(in)}};
  EXPECT_FALSE(report_of(in, path, {attached}).first_contact.has_value());
  // Detached at a new place.
  const AuditReport placed = report_of(in, path, {attached, {at(1200ms), {part_at(0, 0.7)}}});
  ASSERT_TRUE(placed.first_contact.has_value());
  EXPECT_NEAR(to_seconds(placed.first_contact->time), 1.57, 0.0011);
  EXPECT_THAT(bodies_of(*placed.first_contact), UnorderedElementsAre("y_ball", "part"));
}

TEST(AuditScenes, AllowsALinkToTouchAnObjectOnlyWhileListed) {
  const Crossed in;
  const Path path{{0ms, {-1, -1}}, {1s, {0, -1}}, {2s, {-1, -1}}};
  const CollisionObject part = part_at(0.12, 0);  // meets ball x from 0.99 s to 1.01 s
  const auto contact = [&](TimePoint from, TimePoint to) {
    return report_of(in, path,
                     {{at(0ms), {part}},
                      {from, {part}, {}, {{"part", {in.x}}}},
                      {to, {part}, {}, {{"part", {in.y}}}}})
        .first_contact;
  };
  EXPECT_FALSE(contact(at(500ms), at(1500ms)).has_value());
  ASSERT_TRUE(contact(at(995ms), at(1500ms)).has_value());
  EXPECT_NEAR(to_seconds(contact(at(995ms), at(1500ms))->time), 0.99, 0.0011);
  ASSERT_TRUE(contact(at(500ms), at(1'000'500us)).has_value());
  EXPECT_EQ(contact(at(500ms), at(1'000'500us))->time, at(1'000'500us)) << "between two states";
}

TEST(AuditScenes, AllowsAHeldObjectToTouchOnlyWhatIsListed) {
  const Crossed in;
  const CollisionObject post = ball("post", {0.2, 0, 0});
  const Path to_post{{0ms, {-1, -1}}, {1s, {0.05, -1}}};
  const Path to_y{{0ms, {-1, 0}}, {1s, {-0.22, 0}}};
  const auto touches = [&](const Path& path, std::vector<LinkId> links,
                           std::vector<std::string> objects) {
    Attachment part = held_part(in);
    part.touch = std::move(links);
    part.touch_objects = std::move(objects);
    return report_of(in, path, {{at(0ms), {post}, {part}}}).first_contact.has_value();
  };
  EXPECT_FALSE(touches(to_post, {}, {"post"}));
  EXPECT_TRUE(touches(to_post, {in.y}, {"table"}));
  EXPECT_FALSE(touches(to_y, {in.y}, {}));
  EXPECT_TRUE(touches(to_y, {in.x}, {"post"}));
}

TEST(AuditScenes, AllowsTheHandButNoOtherLinkOfTheArm) {
  Cell cell;
  const std::vector<Eigen::Vector3d> axes(3, Eigen::Vector3d::UnitZ());
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), axes, {0.3, 0.03});
  const LinkId hand = *cell.find_link("a_link3");
  const auto report_at = [&](const Eigen::Vector3d& q, const Eigen::Vector3d& p_LO,
                             std::vector<LinkId> touch = {}) {
    Attachment part = held(part_at(0, 0), hand, p_LO);
    part.touch = std::move(touch);
    return audit(cell, {{at(0ms), q}}, 1ms, {{at(0ms), {}, {part}}}).value();
  };
  const AuditReport straight = report_at({0, 0, 0}, {0.3, 0, 0});  // overlaps the hand
  EXPECT_FALSE(straight.first_contact.has_value());
  EXPECT_FALSE(straight.smallest_clearance.has_value()) << "of contact only, within the arm";
  EXPECT_FALSE(report_at({0, 1.57, 1.57}, {0.3, 0, 0}).first_contact.has_value());
  const AuditReport met = report_at({0, 1.57, 1.57}, {0.3, 0.3, 0});
  ASSERT_TRUE(met.first_contact.has_value());
  EXPECT_THAT(bodies_of(*met.first_contact), UnorderedElementsAre("a_link1", "part"));
  EXPECT_FALSE(report_at({0, 1.57, 1.57}, {0.3, 0.3, 0}, {*cell.find_link("a_link1")})
                   .first_contact.has_value());
}

TEST(AuditScenes, AllowsAllLinksOfTheHandAndWhatTheyHold) {
  Cell cell;
  const std::vector<Eigen::Vector3d> axes(3, Eigen::Vector3d::UnitZ());
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), axes, {0.3, 0.03});
  const LinkId finger = *cell.find_link("a_link3");
  const LinkId palm = *cell.find_link("a_link2");
  const RecordedScene scene{at(0ms),
                            {},
                            {held(ball("p", {0, 0, 0}), finger, {-0.05, 0, 0}),
                             held(ball("q", {0, 0, 0}), palm, {0.25, 0.05, 0})}};
  const auto touches = [&] {
    return audit(cell, {{at(0ms), Eigen::Vector3d::Zero()}}, 1ms, {scene})
        ->first_contact.has_value();
  };
  EXPECT_TRUE(touches());
  cell.arms[0].gripper_joints = {*cell.link(finger).driver};
  EXPECT_FALSE(touches());
}

TEST(AuditScenes, ChecksChangesDuringRest) {
  const Crossed in;
  const std::vector<RecordedState> states{{at(0ms), Eigen::Vector2d(-1, -1)},
                                          {at(10s), Eigen::Vector2d(-1, -1), true}};
  const auto report =
      audit(*in.cell, states, 1ms, {{at(4s), {ball("crate", {-1, 0.05, 0})}}, {at(6s), {}}});
  ASSERT_TRUE(report->first_contact.has_value());
  EXPECT_EQ(report->first_contact->time, at(4s));
  EXPECT_EQ(report->states_checked, 4U);
}

// The audit skips pairs by a lower bound of their distance, also over a change of the scene.
TEST(AuditScenes, BoundDistancesFromBelow) {
  const Crossed in;
  std::mt19937 random(7);
  const auto from_to = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(random);
  };
  AuditedCell audited = AuditedCell::build(*in.cell).value();
  std::size_t known = 0;
  for (int i = 0; i < 500; ++i) {
    RecordedScene scene;
    for (const char* name : {"p", "q", "r"}) {
      const CollisionObject object = ball(name, {from_to(-0.9, 0.9), from_to(-0.9, 0.9), 0.5},
                                          from_to(0, 1) < 0.8 ? kPart_m : 0.05);
      const int place = static_cast<int>(from_to(0, 4));
      if (place == 0) scene.objects.push_back(object);
      if (place > 1) {
        scene.held.push_back(held(object, place == 2 ? in.x : in.y, {0, 0, from_to(0.1, 0.5)}));
      }
    }
    AuditedCell fresh = AuditedCell::build(*in.cell).value();
    audited.set_scene(*in.cell, scene);
    fresh.set_scene(*in.cell, scene);
    const Eigen::Vector2d q(from_to(-1, 1), from_to(-1, 1));
    audited.move_to(*in.cell, q);
    fresh.move_to(*in.cell, q);
    ASSERT_EQ(audited.pairs().size(), fresh.pairs().size());
    for (std::size_t k = 0; k < fresh.pairs().size(); ++k) {
      AuditedPair& pair = audited.pairs()[k];
      AuditedPair& other = fresh.pairs()[k];
      ASSERT_EQ(audited.solid(pair.a).name, fresh.solid(other.a).name);
      ASSERT_EQ(audited.solid(pair.b).name, fresh.solid(other.b).name);
      ASSERT_EQ(pair.contact_only, other.contact_only);
      const double distance_m = fresh.look(other, 9.0);
      ASSERT_LE(audited.at_least(pair), distance_m) << i;
      if (audited.at_least(pair) > -9.0) ++known;
      if (from_to(0, 1) < 0.3) {
        EXPECT_DOUBLE_EQ(audited.look(pair, 9.0), distance_m);
      }
    }
  }
  EXPECT_GT(known, 500U);
}

TEST(AuditScenes, KeepTheModelsOfLinksAndOfKnownObjects) {
  const Crossed in;
  AuditedCell audited = AuditedCell::build(*in.cell).value();
  audited.set_scene(*in.cell, {at(0ms), {part_at(0, 0.5)}});
  const auto models = [&] {
    std::vector<const void*> all;
    for (std::size_t i = 0; i < 3; ++i) {
      all.push_back(audited.solid(i).elements.front().surface.collisionGeometry().get());
    }
    return all;
  };
  const auto before = models();
  audited.set_scene(*in.cell, {at(0ms), {}, {held_part(in)}});
  EXPECT_EQ(models(), before);
  audited.set_scene(*in.cell, {at(0ms), {ball("part", {0, 0.5, 0}, 0.05)}});
  EXPECT_NE(models().back(), before.back()) << "another size";
}

TEST(AuditScenes, RefuseWhatCannotBeChecked) {
  const Crossed in;
  const auto states = states_of({{0ms, {-1, -1}}, {5ms, {-1, -1}}});
  const auto unloaded =
      audit(*in.cell, states, 1ms, {{at(0ms), {{.name = "hull", .shape = Mesh{"hull.stl"}}}}});
  ASSERT_FALSE(unloaded.has_value());
  EXPECT_EQ(unloaded.error()[0].slug, "mesh-not-loaded");
  EXPECT_THROW((void)audit(*in.cell, states, 1ms, {{at(2ms), {}}, {at(1ms), {}}}),
               std::invalid_argument);
  const LinkId rail = *in.cell->find_link("x_rail");
  EXPECT_THROW(
      (void)audit(*in.cell, states, 1ms, {{at(0ms), {}, {held(part_at(0, 0), rail, {0, 0, 0})}}}),
      std::invalid_argument);
}

}  // namespace
}  // namespace armloom
