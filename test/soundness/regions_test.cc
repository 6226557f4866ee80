// Compares the regions of pairs of Pandas with exact shapes, at any progress and with tracking
// errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/collision/check/motion_checker.h"
#include "test/bench/cells.h"
#include "test/soundness/pairs.h"

namespace armloom::soundness {
namespace {

constexpr std::size_t kPairs = 120;
constexpr std::size_t kStates = 600;                // per pair, and as many near its outlines
constexpr double kTracking_rad[] = {0.001, 0.005};  // of the left and the right robot
constexpr double kRounding_m = 1e-6;
constexpr double kHorizon_m = 0.05;

bool hold(const PairRegions& pair, Duration a, Duration b) {
  return std::ranges::any_of(pair.regions, [&](const ConflictRegion& region) {
    return std::ranges::any_of(region.boxes, [&](const ProgressBox& box) {
      return box.from_a <= a && a <= box.to_a && box.from_b <= b && b <= box.to_b;
    });
  });
}

// Returns nullptr if the motions have no regions with each other.
const PairRegions* between_motions_of(const Verdict& verdict) {
  const auto found = std::ranges::find_if(verdict.regions, [](const PairRegions& pair) {
    return std::holds_alternative<StepId>(pair.b);
  });
  return found == verdict.regions.end() ? nullptr : &*found;
}

CellPtr promising_pandas() {
  Cell cell = *bench::two_pandas();
  for (std::size_t r = 0; r < cell.robots.size(); ++r) {
    cell.robots[r].controller.tracking_error_rad = kTracking_rad[r];
  }
  return std::make_shared<const Cell>(std::move(cell));
}

struct Tally {
  std::size_t pairs = 0;
  std::size_t with_regions = 0;
  std::size_t boxes_max = 0;
  std::size_t outside = 0;  // states checked
  double closest_m = kHorizon_m;
  std::size_t inside = 0;       // evenly spread states that are inside boxes
  std::size_t inside_free = 0;  // of these, more than kLoose_m above the clearance
};
constexpr double kLoose_m = 0.05;

class Attack {
 public:
  Attack() : exact_(promising_pandas()), random_(31), q_(exact_.cell().home()) {}

  Tally run() {
    const Pool pool(exact_, 40, 32);
    MotionChecker checker(exact_.scene);
    for (const MovingPair& pair : random_pairs(exact_, pool, 2 * kPairs, 33)) {
      if (tally_.pairs == kPairs) break;
      const Verdict verdict =
          checker.judge(pair.question(exact_.cell(), Coordinated{TrackingErrors(exact_.cell())}));
      if (verdict.kind != Verdict::Kind::free) continue;  // a candidate alone is in conflict
      ++tally_.pairs;
      attack(pair, between_motions_of(verdict));
    }
    return tally_;
  }

 private:
  void attack(const MovingPair& pair, const PairRegions* regions) {
    const auto remaining = [&](const Motion& motion) {
      const double now = std::max(0.0, to_seconds(motion.progress));
      return from_seconds(uniform(random_, now, to_seconds(motion.trajectory->duration())));
    };
    for (std::size_t i = 0; i < kStates; ++i) {
      look(pair, regions, remaining(pair.candidate), remaining(pair.other), true);
    }
    if (regions == nullptr) return;
    ++tally_.with_regions;
    std::vector<ProgressBox> boxes;
    for (const ConflictRegion& region : regions->regions) {
      boxes.insert(boxes.end(), region.boxes.begin(), region.boxes.end());
    }
    tally_.boxes_max = std::max(tally_.boxes_max, boxes.size());
    for (std::size_t i = 0; i < kStates; ++i) {
      const ProgressBox& box = boxes[random_() % boxes.size()];
      const double off_s = uniform(random_, 1e-6, 0.01);
      const auto along = [&](Duration from, Duration to) {
        return from_seconds(uniform(random_, to_seconds(from) - off_s, to_seconds(to) + off_s));
      };
      const auto beside = [&](Duration from, Duration to) {
        return random_() % 2 == 0 ? from - from_seconds(off_s) : to + from_seconds(off_s);
      };
      if (random_() % 2 == 0) {
        look(pair, regions, beside(box.from_a, box.to_a), along(box.from_b, box.to_b), false);
      } else {
        look(pair, regions, along(box.from_a, box.to_a), beside(box.from_b, box.to_b), false);
      }
    }
  }

  void look(const MovingPair& pair, const PairRegions* regions, Duration a, Duration b, bool even) {
    const auto remains = [](const Motion& motion, Duration time) {
      return time >= std::max(motion.progress, Duration{}) && time <= motion.trajectory->duration();
    };
    if (!remains(pair.candidate, a) || !remains(pair.other, b)) return;
    const bool held = regions != nullptr && hold(*regions, a, b);
    if (held && !even) return;
    const auto ahead = [](const Motion& motion, Duration time) {
      return to_seconds(time - motion.progress);
    };
    pair.state_at(0.0, ahead(pair.candidate, a), ahead(pair.other, b), q_);
    const double clearance_m = exact_.cell().clearances.clearance_m;
    if (held) {
      ++tally_.inside;
      const double loose_m = clearance_m + kLoose_m;
      if (exact_.between_arms(q_, loose_m) >= loose_m) ++tally_.inside_free;
      return;
    }
    ++tally_.outside;
    const double distance_m = off_the_paths(pair);
    tally_.closest_m = std::min(tally_.closest_m, distance_m);
    EXPECT_GE(distance_m, clearance_m - kRounding_m)
        << "pair " << tally_.pairs << " at " << to_seconds(a) << " and " << to_seconds(b) << " s";
  }

  // Returns the smallest distance found near q_, with each joint off its path.
  double off_the_paths(const MovingPair& pair) {
    double distance_m = exact_.between_arms(q_, kHorizon_m);
    if (distance_m >= kHorizon_m) return distance_m;
    for (const Motion* motion : {&pair.candidate, &pair.other}) {
      for (const JointId joint : motion->trajectory->joints()) {
        double& q = q_[static_cast<Eigen::Index>(joint.index())];
        const double on_path = q;
        double best = on_path;
        const double error = exact_.cell().tracking_error(exact_.cell().joint(joint).robot);
        for (const double off : {-error, error}) {
          q = on_path + off;
          const double found_m = exact_.between_arms(q_, kHorizon_m);
          if (found_m >= distance_m) continue;
          distance_m = found_m;
          best = q;
        }
        q = best;
      }
    }
    return distance_m;
  }

  bench::ExactScene exact_;
  std::mt19937_64 random_;
  Configuration q_;
  Tally tally_;
};

const Tally& tally() {
  static const Tally made = Attack().run();
  return made;
}

TEST(Regions, ContainEveryStateCloserThanTheClearance) {
  EXPECT_EQ(tally().pairs, kPairs);
  EXPECT_GE(tally().with_regions, 30U);
  EXPECT_GE(tally().outside, 80'000U);
  RecordProperty("closest_um", static_cast<int>(1e6 * tally().closest_m));
  EXPECT_LE(tally().closest_m, bench::two_pandas()->clearances.clearance_m + 0.010);
}

TEST(Regions, ContainFewStatesThatAreWellClear) {
  RecordProperty("inside", static_cast<int>(tally().inside));
  RecordProperty("inside_free", static_cast<int>(tally().inside_free));
  RecordProperty("boxes_max", static_cast<int>(tally().boxes_max));
  EXPECT_GE(tally().inside, 300U);
  EXPECT_LE(static_cast<double>(tally().inside_free), 0.1 * static_cast<double>(tally().inside));
}

}  // namespace
}  // namespace armloom::soundness
