#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/collision/check/motion_checker.h"
#include "core/collision/diagram/motion_store.h"
#include "core/collision/scene/scene_bodies.h"
#include "test/collision/scaled_query.h"
#include "test/collision/small_cell.h"
#include "test/model/test_cells.h"

// Defect T8: an attached object collides although the bare arms do not.
namespace armloom {
namespace {

using namespace std::chrono_literals;
using With = Conflict::With;

const ArmId kA{0};
const ArmId kB{1};
const StepId kStep{JobId{1}};
constexpr double kPi = small::kHalfTurn;
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

LinkId link(const Cell& cell, const std::string& name) {
  const auto id = cell.find_link(name);
  EXPECT_TRUE(id.has_value()) << name;
  return id.value_or(LinkId{0});
}

// Returns a rod attached to the end of a link, along x.
Attachment rod_at(const Cell& cell, const std::string& name, const std::string& holder,
                  double link_m, double rod_m) {
  Attachment held{{name, Cylinder{0.015, rod_m}}, link(cell, holder)};
  held.X_LO = small::at_xyz(link_m + rod_m / 2, 0, 0);
  held.X_LO.linear() = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return held;
}

// Returns two arms with one 0.4 m link each that turns about z. The bases are `apart_m` apart along
// x. At 0 rad a points to b, at pi b points to a.
Cell two_arms(double apart_m) {
  Cell cell;
  cell.clearances.clearance_m = 0.02;
  small::add_robot(cell, "a", small::at_xyz(0, 0, 0), {kZ}, {0.4, 0.03});
  small::add_robot(cell, "b", small::at_xyz(apart_m, 0, 0), {kZ}, {0.4, 0.03});
  return cell;
}

PlanningScenePtr holding(const PlanningScenePtr& scene, std::vector<Attachment> attachments) {
  auto held = scene->with_attachments(std::move(attachments));
  EXPECT_TRUE(held.has_value()) << held.error().front().detail;
  return held.value_or(scene);
}

const std::vector<CheckMethod>& methods() {
  static const std::vector<CheckMethod> all{TimedDiscrete{20ms}, Swept{0.001}};
  return all;
}

Question question_of(const Configuration& rest, TrajectoryPtr candidate) {
  return {1, at(0s), {{kStep, std::move(candidate), 0s}}, {}, rest, TimedDiscrete{20ms}};
}

// Checks bare arms, then attached objects, then bare arms again, with one checker. Only the second
// check must find a conflict, between the bodies of `expected`.
void expect_only_held_conflicts(const PlanningScenePtr& bare, const PlanningScenePtr& held,
                                Question question, const Proximity& expected, With with) {
  for (const CheckMethod& method : methods()) {
    question.method = method;
    SCOPED_TRACE(method.index());
    MotionChecker motion_checker(bare);
    EXPECT_EQ(motion_checker.judge(question).kind, Verdict::Kind::free);
    motion_checker.look_at(held);
    const Verdict verdict = motion_checker.judge(question);
    EXPECT_EQ(verdict.kind, Verdict::Kind::conflict);
    ASSERT_FALSE(verdict.conflicts.empty());
    const Conflict& found = verdict.conflicts.front();
    EXPECT_EQ(found.with, with);
    EXPECT_EQ(found.proximity.body_a, expected.body_a);
    EXPECT_EQ(found.proximity.body_b, expected.body_b);
    EXPECT_EQ(found.proximity.arm_a, expected.arm_a);
    EXPECT_EQ(found.proximity.arm_b, expected.arm_b);
    EXPECT_EQ(found.proximity.object_b, expected.object_b);
    EXPECT_EQ(found.proximity.held_a, expected.held_a);
    EXPECT_EQ(found.proximity.held_b, expected.held_b);
    EXPECT_LT(found.proximity.clearance_m, bare->cell().clearances.clearance_m);
    motion_checker.look_at(bare);
    EXPECT_EQ(motion_checker.judge(question).kind, Verdict::Kind::free);
  }
}

TEST(AttachedObject, CollidesWithAnArmThatTheBareArmPasses) {
  const CellPtr cell = small::shared(two_arms(1.2));
  const PlanningScenePtr bare = *PlanningScene::build(cell);
  const PlanningScenePtr held = holding(bare, {rod_at(*cell, "rod", "a_link1", 0.4, 0.5)});
  Configuration rest(2);
  rest << 0.0, kPi;  // b points to a
  const auto past = small::sweep(*cell, {kA}, {-kPi / 2}, {kPi / 2}, 4s);
  expect_only_held_conflicts(bare, held, question_of(rest, past),
                             {"rod", "b_link1", kA, kB, false, 0.0, true, false}, With::rest);
}

TEST(AttachedObject, IsHitByAMovingArmWhileItsOwnArmRests) {
  const CellPtr cell = small::shared(two_arms(1.2));
  const PlanningScenePtr bare = *PlanningScene::build(cell);
  const PlanningScenePtr held = holding(bare, {rod_at(*cell, "rod", "a_link1", 0.4, 0.5)});
  const Configuration rest = Configuration::Zero(2);  // a points to b
  const auto past = small::sweep(*cell, {kB}, {kPi / 2}, {3 * kPi / 2}, 4s);
  expect_only_held_conflicts(bare, held, question_of(rest, past),
                             {"b_link1", "rod", kB, kA, false, 0.0, false, true}, With::rest);
}

TEST(AttachedObject, CollidesWithAnotherArmsAttachedObject) {
  const CellPtr cell = small::shared(two_arms(1.5));
  const PlanningScenePtr bare = *PlanningScene::build(cell);
  const Attachment of_a = rod_at(*cell, "rod of a", "a_link1", 0.4, 0.4);
  const Attachment of_b = rod_at(*cell, "rod of b", "b_link1", 0.4, 0.4);
  Configuration rest(2);
  rest << 0.0, kPi;
  const Question question = question_of(rest, small::sweep(*cell, {kA}, {-kPi / 2}, {kPi / 2}, 4s));
  const PlanningScenePtr one = holding(bare, {of_a});
  expect_only_held_conflicts(one, holding(one, {of_a, of_b}), question,
                             {"rod of a", "rod of b", kA, kB, false, 0.0, true, true}, With::rest);
}

TEST(AttachedObject, CollidesWithTheScene) {
  Cell made = two_arms(3.0);
  made.objects.push_back({"post", Box{{0.1, 0.1, 0.5}}, small::at_xyz(0.0, 0.75, 0.0)});
  const CellPtr cell = small::shared(std::move(made));
  const PlanningScenePtr bare = *PlanningScene::build(cell);
  const PlanningScenePtr held = holding(bare, {rod_at(*cell, "rod", "a_link1", 0.4, 0.5)});
  const auto past = small::sweep(*cell, {kA}, {0.0}, {kPi}, 4s);
  expect_only_held_conflicts(bare, held, question_of(Configuration::Zero(2), past),
                             {"rod", "post", kA, {}, true, 0.0, true, false}, With::scene);
}

// Three 0.3 m links fold up: the tip clears the first link, the attached rod does not.
struct Folding {
  CellPtr cell = [] {
    Cell made;
    made.clearances.clearance_m = 0.02;
    small::add_robot(made, "a", small::at_xyz(0, 0, 0), {kZ, kZ, kZ}, {0.3, 0.03});
    return small::shared(std::move(made));
  }();
  PlanningScenePtr bare = *PlanningScene::build(cell);
  Question question =
      question_of(Configuration::Zero(3),
                  small::sweep(*cell, {kA}, {0.0, kPi / 2, 0.0}, {0.0, kPi / 2, 0.75 * kPi}, 4s));
};

TEST(AttachedObject, CollidesWithItsOwnArm) {
  const Folding folding;
  expect_only_held_conflicts(
      folding.bare, holding(folding.bare, {rod_at(*folding.cell, "rod", "a_link3", 0.3, 0.5)}),
      folding.question, {"a_link1", "rod", kA, kA, false, 0.0, false, true}, With::self);
}

TEST(AttachedObject, MayTouchItsTouchLinks) {
  const Folding folding;
  Attachment rod = rod_at(*folding.cell, "rod", "a_link3", 0.3, 0.5);
  rod.touch = {link(*folding.cell, "a_link1")};
  MotionChecker motion_checker(holding(folding.bare, {rod}));
  for (const CheckMethod& method : methods()) {
    Question question = folding.question;
    question.method = method;
    EXPECT_EQ(motion_checker.judge(question).kind, Verdict::Kind::free) << method.index();
  }
}

TEST(AttachedObject, MayTouchOnlyTheHandThatCarriesIt) {
  const CellPtr cell = build_or_fail(two_pandas_description());
  const PlanningScenePtr bare = *PlanningScene::build(cell);
  // The tool center point link has no shape.
  const PlanningScenePtr scene =
      holding(bare, {{{"rod", Cylinder{0.015, 0.5}}, link(*cell, "left_panda_hand_tcp")},
                     {{"cup", Sphere{0.04}}, link(*cell, "left_panda_leftfinger")}});
  std::set<std::string> with_rod;
  const auto& bodies = scene->bodies();
  for (const BodyPair& pair : bodies.pairs) {
    const std::string& a = bodies.bodies[pair.a].name;
    const std::string& b = bodies.bodies[pair.b].name;
    if (a != "rod" && b != "rod") continue;
    EXPECT_TRUE(with_rod.insert(a == "rod" ? b : a).second) << a << " " << b;
  }
  std::set<std::string> expected;
  for (const CollisionBody& part : bodies.bodies) expected.insert(part.name);
  for (const char* own : {"rod", "cup", "left_panda_link7", "left_panda_hand",
                          "left_panda_leftfinger", "left_panda_rightfinger"}) {
    EXPECT_EQ(expected.erase(own), 1U) << own;
  }
  EXPECT_EQ(with_rod, expected);
}

TEST(AttachedObject, IsRejectedIfInvalid) {
  Cell made = two_arms(1.2);
  made.objects.push_back({"post", Sphere{0.1}, small::at_xyz(0, 0, 2)});
  const CellPtr cell = small::shared(std::move(made));
  const PlanningScenePtr scene = *PlanningScene::build(cell);
  const auto problem = [&](const std::string& name, LinkId holder, std::vector<LinkId> touch = {}) {
    const Attachment ball{{"ball", Sphere{0.05}}, link(*cell, "a_link1")};
    Attachment tried{{name, Sphere{0.05}}, holder};
    tried.touch = std::move(touch);
    const auto made_scene = scene->with_attachments({ball, tried});
    return made_scene ? "" : made_scene.error().front().slug + " " + made_scene.error()[0].pointer;
  };
  const LinkId good = link(*cell, "b_link1");
  EXPECT_EQ(problem("rod", good), "");
  EXPECT_EQ(problem("rod", LinkId{99}), "unknown-link /attachments/1/link");
  EXPECT_EQ(problem("rod", link(*cell, "b_base")), "link-not-of-arm /attachments/1/link");
  EXPECT_EQ(problem("rod", good, {LinkId{99}}), "unknown-link /attachments/1/touch/0");
  EXPECT_EQ(problem("rod", good, {link(*cell, "b_base")}), "");
  for (const char* taken : {"post", "a_link1", "ball"}) {
    EXPECT_EQ(problem(taken, good), "name-taken /attachments/1/object/name");
  }
  const auto objects = holding(scene, {{{"ball", Sphere{0.05}}, good}})
                           ->with_objects({{"cube", Sphere{0.05}}, {"ball", Sphere{0.05}}});
  ASSERT_FALSE(objects.has_value());
  EXPECT_EQ(objects.error().front().pointer, "/objects/1/name");
}

TEST(AttachedObject, StaysWhenSceneObjectsChange) {
  const CellPtr cell = small::shared(two_arms(1.2));
  const PlanningScenePtr scene =
      holding(*PlanningScene::build(cell), {rod_at(*cell, "rod", "a_link1", 0.4, 0.5)});
  const PlanningScenePtr with_post =
      *scene->with_objects({{"post", Sphere{0.1}, small::at_xyz(0.8, 0, 0)}});
  ASSERT_EQ(with_post->attachments().size(), 1U);
  EXPECT_TRUE(with_post->holds_as(*scene));
  small::ScaledQuery checker(with_post);
  Configuration q(2);
  q << 0.0, kPi / 2;
  const auto near = checker.all_closer_than(q, 0.02);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].body_a, "rod");
  EXPECT_EQ(near[0].body_b, "post");
  EXPECT_TRUE(near[0].held_a);
  EXPECT_TRUE(near[0].object_b);

  const PlanningScenePtr empty_handed = holding(with_post, {});
  EXPECT_FALSE(empty_handed->holds_as(*with_post));
  EXPECT_EQ(empty_handed->objects().size(), 1U);
  EXPECT_TRUE(small::ScaledQuery(empty_handed).all_closer_than(q, 0.02).empty());
}

TEST(MotionStore, ForgetsDiagramsOnlyWhenAttachedObjectsChange) {
  const CellPtr cell = small::shared(two_arms(0.9));
  const PlanningScenePtr bare = *PlanningScene::build(cell);
  const Attachment rod = rod_at(*cell, "rod", "a_link1", 0.4, 0.5);
  const Configuration rest = Configuration::Zero(2);
  const auto trajectory = small::sweep(*cell, {kA}, {0.5}, {1.5}, 4s);
  MotionStore store(bare);
  const auto cells_looked_at = [&] {
    store.begin_question();
    auto& a = store.motion(trajectory, kA, rest, 0.0);
    const auto diagram = store.between(a, store.motion(nullptr, kB, rest, 0.0));
    return diagram.ask({.duration_a = 4.0}, 100).evaluations;
  };
  EXPECT_GT(cells_looked_at(), 0U);
  EXPECT_EQ(cells_looked_at(), 0U);
  store.look_at(holding(bare, {rod}));
  EXPECT_GT(cells_looked_at(), 0U);
  store.look_at(*store.scene()->with_objects({{"post", Sphere{0.1}, small::at_xyz(0, 0, 3)}}));
  EXPECT_EQ(cells_looked_at(), 0U);
  store.look_at(holding(store.scene(), {}));
  EXPECT_GT(cells_looked_at(), 0U);
}

// The arm turns about the origin, from 0.5 to 1.5 rad, and reaches 0.4 m.
TEST(MotionStore, ChecksAgainOnlyWhatMeetsTheChange) {
  const CellPtr cell = small::shared(two_arms(0.9));
  const Configuration rest = Configuration::Zero(2);
  const auto trajectory = small::sweep(*cell, {kA}, {0.5}, {1.5}, 4s);
  const auto post_at = [](double angle, double far_m) {
    return CollisionObject{"post", Sphere{0.05},
                           small::at_xyz(far_m * std::cos(angle), far_m * std::sin(angle), 0)};
  };
  const CollisionObject other{"other", Box{{0.1, 0.1, 0.1}}, small::at_xyz(0, 0, 0.8)};
  MotionStore store(*(*PlanningScene::build(cell))->with_objects({other}));
  struct Seen {
    std::uint64_t evaluations;
    bool is_free;
  };
  const auto look = [&](std::vector<CollisionObject> objects) {
    objects.push_back(other);
    store.look_at(*store.scene()->with_objects(std::move(objects)));
    store.begin_question();
    const auto diagram = store.with_still(store.motion(trajectory, kA, rest, 0.0));
    const auto answer = diagram.ask({.duration_a = 4.0}, 1000);
    return Seen{answer.evaluations, !answer.conflict};
  };
  EXPECT_GT(look({}).evaluations, 0U);
  const Seen behind = look({post_at(-1.5, 0.35)});
  EXPECT_EQ(behind.evaluations, 0U) << "within reach, but not near the motion";
  EXPECT_TRUE(behind.is_free);
  EXPECT_EQ(look({post_at(-1.6, 0.35)}).evaluations, 0U);
  const Seen ahead = look({post_at(1.2, 0.35)});
  EXPECT_GT(ahead.evaluations, 0U);
  EXPECT_FALSE(ahead.is_free);
  EXPECT_FALSE(look({post_at(1.2, 0.36)}).is_free) << "it has moved, and is still there";
  EXPECT_TRUE(look({}).is_free);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(look({post_at(1.0 + 0.01 * i, 0.35)}).is_free, false) << i;
    EXPECT_TRUE(look({post_at(-1.5, 0.3)}).is_free) << i;
  }
}

}  // namespace
}  // namespace armloom
