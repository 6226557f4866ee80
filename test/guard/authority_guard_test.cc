#include "core/guard/authority_guard.h"

#include <gtest/gtest.h>

#include <chrono>

namespace armloom {
namespace {

using namespace std::chrono_literals;
using Why = GuardRefusal::Why;

const ArmId kLeft{0}, kRight{1}, kThird{2};
constexpr double kError = 0.001;

// Each arm has one joint, whose number is the arm's number.
JointId joint(ArmId arm) { return JointId{arm.value()}; }

TrajectoryPtr line(const std::vector<ArmId>& arms, double from, double to, Duration takes = 10s) {
  std::vector<JointId> joints;
  for (const ArmId arm : arms) joints.push_back(joint(arm));
  Segment segment{Duration{}, takes, {}};
  segment.coefficients.setZero(static_cast<Eigen::Index>(arms.size()), 6);
  segment.coefficients.col(0).setConstant(from);
  segment.coefficients.col(1).setConstant((to - from) / to_seconds(takes));
  return std::make_shared<const Trajectory>(joints, arms, std::vector<Segment>{segment});
}

CertifiedSide on(const TrajectoryPtr& motion, Duration from = {}) {
  return {motion->arms(), motion, from, std::vector(motion->arms().size(), kError), {}};
}
CertifiedSide resting(ArmId arm, double at) {
  return {{arm}, nullptr, {}, {kError}, {{joint(arm), at}}};
}

class Guarded : public ::testing::Test {
 protected:
  Guarded() {
    content.common = 1;
    content.arms = {11, 12, 13};
    near_all({21, 22});
    guard.emplace(
        std::vector<AuthorityGuard::GuardedArm>{
            {{joint(kLeft)}}, {{joint(kRight)}}, {{joint(kThird)}}},
        Configuration::Zero(3), content);
    guard->take(std::vector<Certificate>{apart(kLeft, kThird), apart(kRight, kThird)});
  }

  Certificate apart(ArmId a, ArmId b) const {
    return ApartCertificate{a, b, content.of({&a, 1}, {&b, 1})};
  }
  Certificate scene(const TrajectoryPtr& motion, Duration from = {}) const {
    return scene(on(motion, from));
  }
  Certificate scene(const CertifiedSide& side) const {
    SceneCertificate proof{side, {}, content.of(side.arms)};
    for (const ArmId arm : side.arms) proof.objects.push_back(content.objects[arm.index()]);
    return proof;
  }
  void near_all(const std::vector<Fingerprint>& objects) { content.objects.assign(3, objects); }
  Certificate pair(CertifiedSide a, CertifiedSide b, std::vector<ProgressBox> blocked = {}) const {
    const Fingerprint geometry = content.of(a.arms, b.arms);
    return PairCertificate{std::move(a), std::move(b), std::move(blocked), geometry};
  }
  void take(std::vector<Certificate> certificates) { guard->take(certificates); }
  std::optional<Why> why(const TrajectoryPtr& motion, Duration authority,
                         Duration from = {}) const {
    const auto refusal = guard->refuses(motion, from, authority);
    return refusal ? std::optional(refusal->why) : std::nullopt;
  }
  void rest(ArmId arm, Duration progress, double at) {
    Configuration q = guard->rest();
    q[arm.value()] = at;
    guard->rests(arm, progress, q);
  }

  SceneFingerprint content;
  std::optional<AuthorityGuard> guard;
  TrajectoryPtr left = line({kLeft}, 0.0, 1.0);
  TrajectoryPtr right = line({kRight}, 0.0, 1.0);
};

TEST_F(Guarded, RefusesWithoutCertificates) {
  EXPECT_EQ(why(left, 1s), Why::uncertified);
  take({scene(left)});
  const auto refusal = guard->refuses(left, {}, 1s);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->why, Why::uncertified);
  EXPECT_EQ(refusal->other, kRight);
}

TEST_F(Guarded, AllowsAuthorityThatCertificatesCover) {
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  EXPECT_EQ(guard->grant(left, {}, 4s), std::nullopt);
  EXPECT_EQ(guard->position(kLeft).authority, 4s);
  EXPECT_FALSE(guard->position(kLeft).at_rest);
}

TEST_F(Guarded, RefusesMotionsBesideAnArmThatMayBeAnywhere) {
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  guard->forget_position(kThird);
  EXPECT_EQ(why(left, 4s), std::nullopt) << "the two arms cannot meet";
  guard->forget_position(kRight);
  EXPECT_EQ(why(left, 4s), Why::uncertified);
  rest(kRight, {}, 0.0);
  EXPECT_EQ(why(left, 4s), std::nullopt);
}

TEST_F(Guarded, NeedsACertificateForTheScene) {
  take({pair(on(left), resting(kRight, 0.0))});
  const auto refusal = guard->refuses(left, {}, 1s);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->why, Why::uncertified);
  EXPECT_EQ(refusal->other, std::nullopt);
}

TEST_F(Guarded, NeedsAValidCertificateForEveryOtherArm) {
  content.arms[2] = 99;  // the third arm now has an object attached
  guard->look_at(content);
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  const auto refusal = guard->refuses(left, {}, 1s);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->other, kThird);
}

TEST_F(Guarded, RefusesIfTheProductOfAuthoritiesMeetsARegion) {
  take({scene(left), scene(right), pair(on(left), resting(kRight, 0.0)),
        pair(on(right), resting(kLeft, 0.0)), pair(on(left), on(right), {{4s, 6s, 2s, 3s}})});
  ASSERT_EQ(guard->grant(left, {}, 5s), std::nullopt);
  EXPECT_EQ(why(right, 1s), std::nullopt);
  EXPECT_EQ(why(right, 2500ms), Why::region);
  EXPECT_EQ(why(right, 2s), std::nullopt) << "up to its edge";
  const auto refusal = guard->refuses(right, {}, 3s);
  ASSERT_TRUE(refusal && refusal->region);
  EXPECT_EQ(refusal->region->from_a, 2s) << "the arm's own motion comes first";
  guard->moves(kLeft, 6s);
  EXPECT_EQ(why(right, 3s), Why::region) << "it may rest on the edge";
  guard->moves(kLeft, 6s + 1ns);
  EXPECT_EQ(why(right, 10s), std::nullopt) << "it has left the region";
}

TEST_F(Guarded, UsesTheAuthorityOfOtherArmsNotOnlyTheirPosition) {
  take({scene(left), scene(right), pair(on(left), resting(kRight, 0.0)),
        pair(on(left), on(right), {{4s, 6s, 2s, 3s}})});
  ASSERT_EQ(guard->grant(left, {}, 4s), std::nullopt);
  EXPECT_EQ(why(right, 5s), std::nullopt);
  ASSERT_EQ(guard->grant(left, {}, 4s + 1ns), std::nullopt);
  EXPECT_EQ(why(right, 5s), Why::region);
}

TEST_F(Guarded, StopEndsAuthorityWhereTheArmRests) {
  take({scene(left), scene(right), pair(on(left), resting(kRight, 0.0)),
        pair(on(left), on(right), {{4s, 6s, 2s, 3s}})});
  ASSERT_EQ(guard->grant(left, {}, 5s), std::nullopt);
  guard->moves(kLeft, 1s);
  EXPECT_EQ(why(right, 5s), Why::region);
  rest(kLeft, 2s, 0.2);
  EXPECT_EQ(why(right, 5s), std::nullopt);
  ASSERT_EQ(guard->grant(right, {}, 5s), std::nullopt);
  EXPECT_EQ(why(left, 5s, 2s), Why::region) << "a resume must pass the guard too";
  EXPECT_EQ(why(left, 3s, 2s), std::nullopt);
}

TEST_F(Guarded, RestartedMotionIsCheckedFromItsStart) {
  const TrajectoryPtr loop = line({kLeft}, 0.0, 0.0);
  take({scene(loop), pair(on(loop), resting(kRight, 0.0), {{2s, 4s, 0s, 0s}})});
  guard->hold(loop, {}, 10s);
  rest(kLeft, 10s, 0.0);
  EXPECT_EQ(why(loop, 1s, 0s), std::nullopt);
  EXPECT_EQ(why(loop, 3s, 0s), Why::region);
}

TEST_F(Guarded, ArmThatRestsOffItsPathIsNotCovered) {
  take(
      {scene(left), scene(right), pair(on(left), resting(kRight, 0.0)), pair(on(right), on(left))});
  ASSERT_EQ(guard->grant(left, {}, 5s), std::nullopt);
  rest(kLeft, 5s, 0.5);
  EXPECT_EQ(why(right, 1s), std::nullopt);
  rest(kLeft, 5s, 0.5 + 2 * kError);
  EXPECT_EQ(why(right, 1s), Why::uncertified);
}

TEST_F(Guarded, ProgressNeverGoesBack) {
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  ASSERT_EQ(guard->grant(left, {}, 5s), std::nullopt);
  guard->moves(kLeft, 3s);
  guard->moves(kLeft, 1s);
  EXPECT_EQ(guard->position(kLeft).measured, 3s);
  ASSERT_EQ(guard->grant(left, {}, 4s), std::nullopt);
  EXPECT_EQ(guard->position(kLeft).authority, 5s) << "granted authority is never reduced";
}

TEST_F(Guarded, RestIsCoveredOnlyWithinItsError) {
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  rest(kRight, {}, 0.9 * kError);
  EXPECT_EQ(why(left, 1s), std::nullopt);
  rest(kRight, {}, 1.1 * kError);
  EXPECT_EQ(why(left, 1s), Why::uncertified);
}

TEST_F(Guarded, RestAtAnEndOfAMotionIsCoveredByThatMotion) {
  take({scene(left), pair(on(left), on(right), {{4s, 6s, 0s, 3s}})});
  EXPECT_EQ(why(left, 3s), std::nullopt) << "right rests where its next motion begins";
  EXPECT_EQ(why(left, 5s), Why::region);
  rest(kRight, {}, 1.0);
  EXPECT_EQ(why(left, 5s), std::nullopt) << "right rests where that motion ends";
  rest(kRight, {}, 0.5);
  EXPECT_EQ(why(left, 5s), Why::uncertified) << "right rests at no certified position";
}

TEST_F(Guarded, RestOnTheEdgeBetweenTwoRectanglesIsInBoth) {
  take({scene(left), scene(right), pair(on(left), resting(kRight, 0.0)),
        pair(on(left), on(right), {{2s, 4s, 0s, 9s}, {4s, 6s, 0s, 9s}})});
  ASSERT_EQ(guard->grant(left, {}, 1s), std::nullopt);
  rest(kLeft, 4s, 0.4);
  EXPECT_EQ(why(right, 1s), Why::region);
}

TEST_F(Guarded, MovingArmIsNotCoveredByARestCertificate) {
  take({scene(left), scene(right), pair(on(left), resting(kRight, 0.0)),
        pair(on(right), resting(kLeft, 0.0))});
  ASSERT_EQ(guard->grant(right, {}, 5s), std::nullopt);
  EXPECT_EQ(why(left, 1s), Why::uncertified);
}

TEST_F(Guarded, StartOffThePathNeedsACertificateWithThatError) {
  const TrajectoryPtr off = line({kLeft}, 0.005, 1.0);
  take({scene(off), pair(on(off), resting(kRight, 0.0))});
  EXPECT_EQ(why(off, 1s), Why::uncertified);
  EXPECT_NEAR(guard->off_path(off, {}), 0.005, 1e-12);
  CertifiedSide wide = on(off);
  wide.errors = {0.006};
  take({scene(wide), pair(wide, resting(kRight, 0.0))});
  ASSERT_EQ(guard->grant(off, {}, 1s), std::nullopt);
  guard->moves(kLeft, 1s);
  take({scene(right), pair(on(right), on(off))});
  EXPECT_EQ(why(right, 1s), Why::uncertified) << "left is still off its path";
}

TEST_F(Guarded, ArmThatLeavesItsPathIsNotCoveredUntilItRests) {
  take({scene(left), scene(right), pair(on(left), on(right))});
  ASSERT_EQ(guard->grant(left, Duration{}, 4s), std::nullopt);
  ASSERT_EQ(guard->grant(right, Duration{}, 4s), std::nullopt);
  EXPECT_TRUE(guard->certifies(kLeft, kRight));
  EXPECT_TRUE(guard->certifies_scene(kRight));
  guard->moves(kRight, 1s);
  guard->leaves_path(kRight, 2 * kError);
  EXPECT_FALSE(guard->certifies(kLeft, kRight));
  EXPECT_FALSE(guard->certifies(kRight, kLeft));
  EXPECT_FALSE(guard->certifies_scene(kRight));
  EXPECT_TRUE(guard->certifies_scene(kLeft));
  EXPECT_EQ(guard->refuses(left, std::nullopt, 5s)->why, Why::uncertified);
  rest(kRight, 1s, 0.1);  // back on its path
  EXPECT_TRUE(guard->certifies(kLeft, kRight));
  EXPECT_EQ(guard->refuses(left, std::nullopt, 5s), std::nullopt);
}

TEST_F(Guarded, CertificateIsValidFromItsProgressOn) {
  take({scene(left, 2s), pair(on(left, 2s), resting(kRight, 0.0))});
  EXPECT_EQ(why(left, 5s), Why::uncertified);
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  ASSERT_EQ(guard->grant(left, {}, 5s), std::nullopt);
  take({scene(right), pair(on(right), on(left, 2s))});
  EXPECT_EQ(why(right, 1s), Why::uncertified);
  guard->moves(kLeft, 2s);
  EXPECT_EQ(why(right, 1s), std::nullopt);
}

TEST_F(Guarded, JointsAtRestMustMatchTheCertificate) {
  CertifiedSide side = on(left);
  side.still = {{joint(kLeft), 0.5}};
  take({scene(left), pair(side, resting(kRight, 0.0))});
  EXPECT_EQ(why(left, 1s), Why::uncertified);
}

TEST_F(Guarded, ChangedObjectInvalidatesOnlyOlderSceneCertificates) {
  take(
      {scene(left), pair(on(left), resting(kRight, 0.0)), scene(right), pair(on(right), on(left))});
  const TrajectoryPtr other = right;
  near_all({22, 31});  // object 21 was replaced by 31
  guard->look_at(content);
  EXPECT_EQ(why(left, 1s), Why::uncertified);
  take({scene(left)});
  EXPECT_EQ(why(left, 1s), std::nullopt) << "the pair's certificate names no object";
  near_all({22});
  guard->look_at(content);
  EXPECT_EQ(why(left, 1s), std::nullopt) << "removing an object endangers no arm";
}

TEST_F(Guarded, ObjectOutOfReachInvalidatesNothing) {
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  const SceneFingerprint before = content;
  content.objects[kRight.index()] = {22, 31};
  guard->look_at(content);
  EXPECT_EQ(why(left, 1s), std::nullopt);
  EXPECT_EQ(arms_in_question(before, content), std::vector{kRight});
  content.arms[kThird.index()] = 99;
  EXPECT_EQ(arms_in_question(before, content), (std::vector{kLeft, kRight, kThird}));
}

TEST_F(Guarded, CertificateForAnOlderSceneReplacesNothing) {
  const Certificate older = scene(left);
  near_all({21, 22, 31});
  guard->look_at(content);
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  take({older});
  EXPECT_EQ(why(left, 1s), std::nullopt);
}

TEST_F(Guarded, AttachedObjectInvalidatesOnlyCertificatesOfItsArm) {
  const TrajectoryPtr third = line({kThird}, 0.0, 1.0);
  take({scene(left), pair(on(left), resting(kRight, 0.0)), scene(third)});
  content.arms[kRight.index()] = 99;
  guard->look_at(content);
  EXPECT_EQ(why(left, 1s), Why::uncertified);
  take({apart(kRight, kThird)});
  EXPECT_EQ(why(third, 1s), std::nullopt);
}

TEST_F(Guarded, ChangedClearancesInvalidateAllCertificates) {
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  content.common = 2;
  guard->look_at(content);
  EXPECT_EQ(why(left, 1s), Why::uncertified);
}

TEST_F(Guarded, OneCoveringCertificateIsEnough) {
  take({scene(left), pair(on(left), resting(kRight, 0.0), {{4s, 6s, 0s, 0s}})});
  EXPECT_EQ(why(left, 5s), Why::region);
  take({pair(on(left), resting(kRight, 0.0), {{7s, 8s, 0s, 0s}})});
  EXPECT_EQ(why(left, 5s), std::nullopt);
  EXPECT_EQ(why(left, 7500ms), Why::region) << "neither covers the whole range";
}

TEST_F(Guarded, RefusesAMotionOfAnArmThatIsOnAnotherMotion) {
  const TrajectoryPtr second = line({kLeft}, 0.0, -1.0);
  take({scene(left), pair(on(left), resting(kRight, 0.0)), scene(second),
        pair(on(second), resting(kRight, 0.0))});
  ASSERT_EQ(guard->grant(left, {}, 1s), std::nullopt);
  EXPECT_EQ(why(second, 1s), Why::busy);
}

TEST_F(Guarded, ForgetsAMotionOnceNoArmIsOnIt) {
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  ASSERT_EQ(guard->grant(left, {}, 10s), std::nullopt);
  take({scene(right), pair(on(right), on(left))});
  rest(kLeft, 10s, 1.0);
  guard->forget(left);
  EXPECT_EQ(why(right, 1s), std::nullopt) << "left still rests on it";
  const TrajectoryPtr back = line({kLeft}, 1.0, 0.0);
  take({scene(back), pair(on(back), on(right))});
  ASSERT_EQ(guard->grant(back, {}, 1s), std::nullopt);
  guard->forget(right);
  EXPECT_EQ(left.use_count(), 1);
}

TEST_F(Guarded, EvictsOldMotionsBeyondItsLimit) {
  for (int i = 0; i < 200; ++i) take({scene(line({kLeft}, 0.0, 1.0 + i))});
  take({scene(left), pair(on(left), resting(kRight, 0.0))});
  EXPECT_EQ(why(left, 1s), std::nullopt);
}

TEST_F(Guarded, EvictsOldRestsOfAnArmBeyondItsLimit) {
  take({scene(left)});
  for (int i = 0; i < 200; ++i) take({pair(on(left), resting(kRight, 1.0 + i))});
  take({pair(on(left), resting(kRight, 0.0))});
  EXPECT_EQ(why(left, 1s), std::nullopt);
}

class GuardedTogether : public Guarded {
 protected:
  GuardedTogether() {
    take({scene(both), TogetherCertificate{on(both), 100ms, content.of(both->arms())}});
  }
  TrajectoryPtr both = line({kLeft, kRight}, 0.0, 1.0);
};

TEST_F(GuardedTogether, RefusesIfArmsOfOneMotionAreOutOfStep) {
  ASSERT_EQ(guard->grant(both, {}, 5s), std::nullopt);
  guard->moves(kLeft, 1100ms);
  guard->moves(kRight, 1s);
  EXPECT_EQ(why(both, 6s), std::nullopt);
  guard->moves(kLeft, 1101ms);
  EXPECT_EQ(why(both, 6s), Why::out_of_step);
}

TEST_F(GuardedTogether, NeedsATogetherCertificate) {
  const TrajectoryPtr other = line({kLeft, kRight}, 0.0, -1.0);
  take({scene(other)});
  EXPECT_EQ(why(other, 1s), Why::uncertified);
}

TEST_F(GuardedTogether, ChecksEachArmOfTheMotion) {
  content.arms[2] = 99;
  guard->look_at(content);
  take({apart(kLeft, kThird), scene(both),
        TogetherCertificate{on(both), 100ms, content.of(both->arms())}});
  const auto refusal = guard->refuses(both, {}, 1s);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->arm, kRight);
  EXPECT_EQ(refusal->other, kThird);
}

}  // namespace
}  // namespace armloom
