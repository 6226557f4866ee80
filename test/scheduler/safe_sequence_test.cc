#include "core/sequence/safe_sequence.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace armloom {
namespace {

using Steps = std::vector<StepId>;

// Positions are numbers. Tests set by hand which passages are blocked.
class Lanes {
 public:
  explicit Lanes(std::size_t arms) : stands_(arms, 0.0), ends_(arms, 0.0) {}

  StepId leg(std::vector<std::uint32_t> arms, double to, Steps after = {}) {
    WaitingLeg leg{
        .step = StepId{JobId{++last_}}, .arms = {}, .from = {}, .to = {}, .after = after};
    for (std::uint32_t arm : arms) {
      leg.arms.emplace_back(arm);
      leg.from.push_back(place(arm, ends_[arm]));
      leg.to.push_back(place(arm, ends_[arm] = to));
    }
    legs_.push_back(leg);
    if (renewed_) sequence.append(leg);
    return leg.step;
  }
  void blocked(StepId leg, std::uint32_t arm, double at) {
    blocked_.insert({leg, place(arm, at)->id});
  }

  SafeSequence::Outlook after(const Steps& group) {
    if (!renewed_) renew();
    for (;;) {
      auto outlook = sequence.after(group);
      std::vector<Passage> unknown = outlook.unknown;
      unknown.insert(unknown.end(), outlook.ahead.begin(), outlook.ahead.end());
      if (unknown.empty()) return outlook;
      for (const Passage& passage : unknown) {
        const bool asked_twice = !known_.insert({passage.leg, passage.place->id}).second;
        if (asked_twice) continue;
        ++asked;
        sequence.learn(passage, passes(passage.leg, passage.place));
      }
    }
  }
  void admit(const Steps& group) {
    (void)after(group);
    sequence.admitted(group);
    for (StepId step : group) go(step);
  }
  [[nodiscard]] bool passes_now(StepId step) {
    const WaitingLeg& leg = of(step);
    for (std::uint32_t arm = 0; arm < stands_.size(); ++arm) {
      const bool own = std::ranges::find(leg.arms, ArmId{arm}) != leg.arms.end();
      if (!own && !passes(step, place(arm, stands_[arm]))) return false;
    }
    return true;
  }
  [[nodiscard]] Steps heads() const {
    Steps heads;
    std::set<ArmId> taken;
    std::set<StepId> waiting;
    for (const WaitingLeg& leg : legs_) {
      bool first = true;
      for (ArmId arm : leg.arms) first = taken.insert(arm).second && first;
      for (StepId before : leg.after) first = first && !waiting.contains(before);
      if (first) heads.push_back(leg.step);
      waiting.insert(leg.step);
    }
    return heads;
  }
  [[nodiscard]] double end_of(std::uint32_t arm) const { return ends_[arm]; }
  [[nodiscard]] bool done() const { return legs_.empty(); }

  SafeSequence sequence{0.01};
  std::size_t asked = 0;

 private:
  PlacePtr place(std::uint32_t arm, double at) {
    return places_.of(ArmId{arm}, Eigen::VectorXd::Constant(1, at));
  }
  [[nodiscard]] const WaitingLeg& of(StepId step) const {
    return *std::ranges::find(legs_, step, &WaitingLeg::step);
  }
  [[nodiscard]] bool passes(StepId leg, const PlacePtr& place) const {
    return !blocked_.contains({leg, place->id});
  }
  void renew() {
    std::vector<PlacePtr> stands;
    for (std::uint32_t arm = 0; arm < stands_.size(); ++arm)
      stands.push_back(place(arm, stands_[arm]));
    sequence.renew(stands, legs_);
    renewed_ = true;
  }
  void go(StepId step) {
    for (const PlacePtr& to : of(step).to) stands_[to->arm.index()] = to->q[0];
    std::erase_if(legs_, [step](const WaitingLeg& leg) { return leg.step == step; });
  }

  Places places_;
  std::vector<double> stands_, ends_;
  std::vector<WaitingLeg> legs_;
  std::set<std::pair<StepId, std::uint64_t>> blocked_, known_;
  std::uint64_t last_ = 0;
  bool renewed_ = false;
};

constexpr std::uint32_t kA = 0, kB = 1, kC = 2;

// Answers for a position must stay known while no object uses the position.
TEST(Places, KeepTheIdOfAReleasedPosition) {
  Places places;
  const auto id = [&](std::uint32_t arm, double at) {
    return places.of(ArmId{arm}, Eigen::VectorXd::Constant(2, at))->id;  // no reference is kept
  };
  std::set<std::uint64_t> ids;
  for (int i = 0; i < 1000; ++i) {
    const double at = 0.01 * i - 5.0;
    EXPECT_EQ(id(0, at), id(0, at));
    ids.insert({id(0, at), id(1, at)});
  }
  EXPECT_EQ(ids.size(), 2000U);
}

TEST(SafeSequence, AnyMotionMayGoIfNoArmIsInTheWay) {
  Lanes lanes(2);
  const StepId a = lanes.leg({kA}, 1.0), b = lanes.leg({kB}, 1.0);
  EXPECT_FALSE(lanes.after({a}).first);
  EXPECT_FALSE(lanes.after({b}).first);
}

TEST(SafeSequence, MotionWhoseGoalIsInTheWayWaits) {
  Lanes lanes(2);
  const StepId b = lanes.leg({kB}, 1.0), a = lanes.leg({kA}, 1.0);
  lanes.blocked(b, kA, 1.0);
  EXPECT_EQ(lanes.after({a}).first, b);
  EXPECT_FALSE(lanes.after({b}).first);
}

TEST(SafeSequence, FindsAnotherOrderThanThatOfSubmission) {
  Lanes lanes(2);
  const StepId a = lanes.leg({kA}, 1.0), b = lanes.leg({kB}, 1.0);
  lanes.blocked(b, kA, 1.0);
  EXPECT_EQ(lanes.after({a}).first, b);
  EXPECT_TRUE(lanes.after({b}).all);
}

TEST(SafeSequence, SwapCausesNoWait) {
  Lanes lanes(2);
  const StepId a = lanes.leg({kA}, 1.0), b = lanes.leg({kB}, 1.0);
  lanes.blocked(a, kB, 0.0);
  lanes.blocked(b, kA, 0.0);
  lanes.blocked(b, kA, 1.0);
  lanes.blocked(a, kB, 1.0);
  const auto outlook = lanes.after({a});
  EXPECT_FALSE(outlook.first);
  EXPECT_FALSE(outlook.all);
  EXPECT_TRUE(lanes.after({a, b}).all);
}

TEST(SafeSequence, GoalInTheWayDoesNotBlockIfTheNextMotionLeavesIt) {
  Lanes lanes(2);
  const StepId a1 = lanes.leg({kA}, 1.0), a2 = lanes.leg({kA}, 2.0), b = lanes.leg({kB}, 1.0);
  lanes.blocked(b, kA, 1.0);
  EXPECT_FALSE(lanes.after({a1}).first);
  lanes.blocked(a2, kB, 1.0);
  lanes.admit({a1});
  EXPECT_EQ(lanes.after({a2}).first, std::nullopt);
}

TEST(SafeSequence, TwoArmMotionGoesWhenFirstInBothQueues) {
  Lanes lanes(3);
  lanes.leg({kA}, 1.0);
  const StepId both = lanes.leg({kA, kB}, 2.0), c = lanes.leg({kC}, 1.0);
  lanes.blocked(both, kC, 1.0);
  EXPECT_EQ(lanes.after({c}).first, both);
}

TEST(SafeSequence, SuccessorDoesNotGoBeforeItsPredecessor) {
  Lanes lanes(3);
  const StepId a = lanes.leg({kA}, 1.0);
  const StepId b = lanes.leg({kB}, 1.0, {a});
  const StepId c = lanes.leg({kC}, 1.0);
  lanes.blocked(a, kC, 1.0);
  lanes.blocked(b, kC, 0.0);
  EXPECT_EQ(lanes.after({c}).first, a) << "b cannot unblock c before a: b comes after a";
}

TEST(SafeSequence, MotionsThatReturnNeedNoQuestions) {
  Lanes lanes(2);
  for (int n = 0; n < 100; ++n) lanes.leg({kA}, 0.0);
  const StepId b = lanes.leg({kB}, 0.0);
  EXPECT_FALSE(lanes.after({b}).first);
  EXPECT_EQ(lanes.asked, SafeSequence::kKnownAhead);
}

TEST(SafeSequence, AfterACancelJobsThatStartElsewhereLeaveTheSequence) {
  Lanes lanes(2);
  const StepId a1 = lanes.leg({kA}, 1.0), a2 = lanes.leg({kA}, 2.0), b = lanes.leg({kB}, 1.0);
  EXPECT_FALSE(lanes.after({b}).first);
  EXPECT_TRUE(lanes.sequence.follows_on(a2));
  EXPECT_FALSE(lanes.sequence.remove(a1)) << "the caller must call renew()";
}

// Adds random motions. In order of submission all are free; in another order some may be blocked.
void add_random_legs(Lanes& lanes, std::uint32_t arms, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint64_t n) { return static_cast<std::uint32_t>(random() % n); };
  std::vector<double> stands(arms, 0.0);
  Steps all;
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<std::uint32_t> own{below(arms)};
    if (below(8) == 0 && below(arms) != own[0]) own.push_back((own[0] + 1) % arms);
    Steps after;
    if (!all.empty() && below(4) == 0) after.push_back(all[below(all.size())]);
    const StepId step = lanes.leg(own, below(6), after);
    for (std::uint32_t arm = 0; arm < arms; ++arm) {
      for (int at = 0; at < 6; ++at) {
        const bool is_own = std::ranges::find(own, arm) != own.end();
        if (!is_own && at != stands[arm] && below(3) == 0) lanes.blocked(step, arm, at);
      }
    }
    all.push_back(step);
    for (std::uint32_t arm : own) stands[arm] = lanes.end_of(arm);
  }
}

TEST(SafeSequence, AllMotionsEndWhicheverAreAdmitted) {
  std::size_t waits = 0, ahead = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    std::mt19937_64 random(seed);
    const auto arms = static_cast<std::uint32_t>(2 + random() % 3);
    Lanes lanes(arms);
    add_random_legs(lanes, arms, 8 + seed % 60, random());
    while (!lanes.done()) {
      Steps go;
      for (StepId head : lanes.heads()) {
        if (!lanes.passes_now(head)) continue;
        if (lanes.after({head}).first) {
          ++waits;
        } else {
          go.push_back(head);
        }
      }
      ASSERT_FALSE(go.empty()) << "seed " << seed << ": nothing can go any more";
      const StepId chosen = go[random() % go.size()];
      if (chosen != go.front()) ++ahead;
      lanes.admit({chosen});
    }
  }
  EXPECT_GT(waits, 300U);
  EXPECT_GT(ahead, 300U);
}

}  // namespace
}  // namespace armloom
