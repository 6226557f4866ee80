#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/collision/filter/arm_kinematics.h"
#include "core/collision/filter/kernels.h"
#include "core/geometry/capsule/segment_distance.h"
#include "test/soundness/filter_check.h"
#include "test/soundness/pairs.h"
#include "test/soundness/random_linkage.h"

namespace armloom::soundness {
namespace {

constexpr int kLanes = filter::kLanes;

void expect_never_too_far(const CellPtr& cell, std::size_t states) {
  const FilterReport report = check_filter(cell, states, 31);
  EXPECT_GE(report.states, states);
  EXPECT_GE(report.part_pairs, 50 * states);
  EXPECT_GE(2 * report.by_fcl, states);
  EXPECT_EQ(report.left_out, 0U);
  EXPECT_EQ(report.too_far, 0U) << "by up to " << report.worst_m << " m";
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
}

TEST(Filter, NeverExceedsTheExactDistanceOfTwoPandas) {
  expect_never_too_far(cell_of_file("two_pandas.json"), 10'000);
}

TEST(Filter, NeverExceedsTheExactDistanceOfAPandaAndAUr5e) {
  expect_never_too_far(cell_of_file("panda_and_ur5e.json"), 2'000);
}

TEST(Filter, NeverExceedsTheExactDistanceOfADualArmRobot) {
  expect_never_too_far(cell_of_file("dual_panda.json"), 2'000);
}

TEST(Filter, NeverExceedsTheExactDistanceOfArmsWithMeshes) {
  expect_never_too_far(cell_of_file("two_shuttles.json"), 2'000);
}

TEST(Filter, HasARoundingMarginOfAtMostTenMicrometers) {
  const FilterReport report = check_filter(cell_of_file("two_pandas.json"), 8, 1);
  EXPECT_GT(report.margin_m, 1e-7);
  EXPECT_LE(report.margin_m, 1e-5);
}

struct Comparison {
  const RandomLinkage& arm;
  std::vector<double> q;
  std::vector<float> span;
  std::vector<filter::Pair> pairs = {};
  std::vector<filter::StaticBox> boxes = {};
  std::vector<filter::BoxedCapsule> boxed = {};
  unsigned lanes = 0xFF;
};

struct Results {
  Results(const filter::Kernel& kernel, const Comparison& of) : Results(kernel, of, of.arm) {}

  std::vector<double> frames;
  std::vector<float> axes, capsules, motion_bounds, sweeps, spread;
  std::vector<filter::Hit> hits, box_hits, unskipped_box_hits;

 private:
  Results(const filter::Kernel& kernel, const Comparison& of, const RandomLinkage& arm)
      : frames(arm.frames.size() * 12 * kLanes),
        axes(arm.frames.size() * 6 * kLanes),
        capsules(arm.capsules.size() * 6 * kLanes),
        motion_bounds(static_cast<std::size_t>(arm.rows) * kLanes),
        sweeps(arm.capsules.size() * filter::kSweep * kLanes),
        hits(of.pairs.size() + 1),
        box_hits(of.boxes.size() * of.boxed.size() + 1) {
    const filter::Placed placed{frames.data(), axes.data(), capsules.data()};
    kernel.place(arm.view(), of.q.data(), placed);
    kernel.inflate(arm.view(), placed, {of.span.data(), of.span.data(), of.span.data()},
                   {motion_bounds.data(), sweeps.data()});
    const filter::Side side{.capsules = capsules.data(),
                            .motion_bound = motion_bounds.data(),
                            .ball = nullptr,
                            .sweeps = sweeps.data()};
    const filter::Pairs pairs{of.pairs.data(), static_cast<int>(of.pairs.size()), {}};
    hits.resize(
        static_cast<std::size_t>(kernel.near_pairs(side, side, pairs, of.lanes, hits.data())));
    std::vector<int> rows;
    for (const filter::Capsule& capsule : arm.capsules) rows.push_back(capsule.motion_bounds_begin);
    std::vector<float> ball(4 * kLanes);
    const long spread_size = filter::spread_size(static_cast<int>(arm.capsules.size()));
    spread.resize(static_cast<std::size_t>(4 * spread_size));
    kernel.enclose(arm.view(), capsules.data(), motion_bounds.data(), rows.data(), ball.data(),
                   spread.data());
    const filter::Boxes boxes{of.boxes.data(), static_cast<int>(of.boxes.size()), of.boxed.data()};
    const auto hits_of = [&](const filter::Side& of_side) {
      std::vector<filter::Hit> found(of.boxes.size() * of.boxed.size() + 1);
      found.resize(
          static_cast<std::size_t>(kernel.near_boxes(of_side, boxes, of.lanes, found.data())));
      return found;
    };
    box_hits = hits_of({capsules.data(),
                        motion_bounds.data(),
                        ball.data(),
                        {spread.data(), spread_size},
                        sweeps.data()});
    unskipped_box_hits = hits_of(side);  // without the balls
  }
};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_hits(const std::vector<filter::Hit>& a, const std::vector<filter::Hit>& b) {
  return std::ranges::equal(a, b, [](const filter::Hit& x, const filter::Hit& y) {
    if (x.pair != y.pair || x.lanes != y.lanes) return false;
    for (int l = 0; l < kLanes; ++l) {
      if ((x.lanes >> l & 1U) == 0) continue;
      if (std::memcmp(&x.distance[l], &y.distance[l], sizeof(float)) != 0) return false;
      if (std::memcmp(&x.motion_bound[l], &y.motion_bound[l], sizeof(float)) != 0) return false;
    }
    return true;
  });
}

std::vector<filter::Pair> all_pairs(const RandomLinkage& arm, std::mt19937_64& random) {
  std::vector<filter::Pair> pairs;
  for (int a = 0; a < static_cast<int>(arm.capsules.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(arm.capsules.size()); ++b) {
      const filter::Capsule& at_a = arm.capsules[static_cast<std::size_t>(a)];
      const filter::Capsule& at_b = arm.capsules[static_cast<std::size_t>(b)];
      filter::Pair pair = kernel_pair({a, at_a}, {b, at_b}, uniform(random, 0.0, 0.4), 1e-6);
      pair.row_a = at_a.motion_bounds_begin;
      pair.row_b = at_b.motion_bounds_begin;
      pairs.push_back(pair);
    }
  }
  return pairs;
}

std::vector<filter::BoxedCapsule> boxed_capsules(const RandomLinkage& arm) {
  std::vector<filter::BoxedCapsule> boxed;
  for (int a = 0; a < static_cast<int>(arm.capsules.size()); ++a) {
    const filter::Capsule& capsule = arm.capsules[static_cast<std::size_t>(a)];
    boxed.push_back({a, capsule.motion_bounds_begin, capsule.radius_up, capsule.ball_up});
  }
  return boxed;
}

std::vector<filter::StaticBox> boxes_for(const RandomLinkage& arm, std::mt19937_64& random) {
  std::vector<filter::StaticBox> boxes;
  for (int a = 0; a < static_cast<int>(arm.capsules.size()); ++a) {
    filter::StaticBox box{};
    box.R[0] = box.R[4] = box.R[8] = 1.0F;
    float squared = 0.0F;
    for (float& x : box.center) x = static_cast<float>(uniform(random, -1.0, 1.0));
    for (float& x : box.half_up) {
      x = static_cast<float>(uniform(random, 0.0, 0.5));
      squared += x * x;
    }
    box.ball_up = std::sqrt(squared) * 1.00001F;
    box.limit_up = 0.1F;
    box.begin = a;
    box.end = static_cast<int>(arm.capsules.size());
    boxes.push_back(box);
  }
  return boxes;
}

// Each hit without skipping is also a hit with skipping, or the capsule is far from the box.
void expect_skips_only_far_boxes(const Comparison& of, const Results& results) {
  auto kept = results.box_hits.begin();
  for (const filter::Hit& hit : results.unskipped_box_hits) {
    if (kept != results.box_hits.end() && kept->pair == hit.pair && kept->capsule == hit.capsule) {
      EXPECT_EQ(kept->lanes, hit.lanes);
      ++kept;
      continue;
    }
    const filter::StaticBox& box = of.boxes[static_cast<std::size_t>(hit.pair)];
    const int capsule = of.boxed[static_cast<std::size_t>(hit.capsule)].capsule;
    for (int l = 0; l < kLanes; ++l) {
      if ((hit.lanes >> l & 1U) == 0) continue;
      CenteredSegment axis;
      Eigen::Vector3d half_m;
      for (int i = 0; i < 3; ++i) {
        const auto at = [&](int row) {
          return static_cast<double>(
              results.capsules[static_cast<std::size_t>((capsule * 6 + row) * kLanes + l)]);
        };
        axis.center[i] = at(i) - static_cast<double>(box.center[i]);
        axis.half[i] = at(3 + i);
        half_m[i] = static_cast<double>(box.half_up[i]);
      }
      const double radius_m = of.boxed[static_cast<std::size_t>(hit.capsule)].radius_up;
      EXPECT_GE(segment_box_distance(axis, half_m) - radius_m,
                static_cast<double>(box.limit_up + hit.motion_bound[l]) - 1e-5);
    }
  }
  EXPECT_EQ(kept, results.box_hits.end());
}

TEST(Kernels, AreBitIdenticalOnEveryInstructionSet) {
  const std::vector<const filter::Kernel*> kernels = filter::kernels();
  ASSERT_GE(kernels.size(), 2U);
  ASSERT_EQ(kernels.front(), &filter::kScalarKernel);
  std::mt19937_64 random(41);
  std::size_t hits = 0, left_out = 0;
  for (int round = 0; round < 1'250; ++round) {  // of eight configurations each
    const RandomLinkage arm(random);
    Comparison of{arm, std::vector<double>(static_cast<std::size_t>(arm.joints * kLanes)),
                  std::vector<float>(arm.frames.size() * kLanes)};
    for (double& x : of.q) x = random() % 8 == 0 ? 0.0 : uniform(random, -7.0, 7.0);
    if (round % 2 == 0) {  // similar lanes, as along a line: far from some boxes all at once
      for (std::size_t i = 0; i < of.q.size(); ++i) {
        if (i % kLanes > 0) of.q[i] = of.q[i - 1] + uniform(random, 0.0, 0.05);
      }
    }
    for (float& x : of.span) x = static_cast<float>(uniform(random, 0.0, 0.05));
    of.pairs = all_pairs(arm, random);
    of.boxes = boxes_for(arm, random);
    of.boxed = boxed_capsules(arm);
    of.lanes = static_cast<unsigned>(random() % 256);
    const Results reference(filter::kScalarKernel, of);
    hits += reference.hits.size();
    left_out += of.pairs.size() - reference.hits.size();
    for (const filter::Kernel* kernel : kernels) {
      const Results results(*kernel, of);
      ASSERT_TRUE(same_bits(reference.frames, results.frames)) << kernel->name;
      ASSERT_TRUE(same_bits(reference.axes, results.axes)) << kernel->name;
      ASSERT_TRUE(same_bits(reference.capsules, results.capsules)) << kernel->name;
      ASSERT_TRUE(same_bits(reference.spread, results.spread)) << kernel->name;
      ASSERT_TRUE(same_hits(reference.hits, results.hits)) << kernel->name;
      ASSERT_TRUE(same_hits(reference.box_hits, results.box_hits)) << kernel->name;
      expect_skips_only_far_boxes(of, results);
      for (const filter::Capsule& c : arm.capsules) {
        for (int row = c.motion_bounds_begin; row <= c.motion_bounds_begin + c.depth; ++row) {
          const auto at = static_cast<std::size_t>(row * kLanes);
          ASSERT_EQ(std::memcmp(&reference.motion_bounds[at], &results.motion_bounds[at],
                                kLanes * sizeof(float)),
                    0)
              << kernel->name;
        }
      }
    }
  }
  EXPECT_GE(hits, 10'000U);
  EXPECT_GE(left_out, 10'000U);
}

TEST(Kernels, BoundEveryMotionWithinTheSpans) {
  std::mt19937_64 random(43);
  const filter::Kernel& kernel = filter::best_kernel();
  double tightest = 0.0;
  for (int round = 0; round < 400; ++round) {
    const RandomLinkage arm(random);
    std::vector<double> q(static_cast<std::size_t>(arm.joints * kLanes));
    for (double& x : q) x = uniform(random, -3.0, 3.0);
    std::vector<double> moved = q;
    std::vector<double> most(static_cast<std::size_t>(arm.joints));
    for (double& m : most) m = random() % 3 == 0 ? 0.0 : uniform(random, 0.0, 0.5);
    for (std::size_t i = 0; i < q.size(); ++i) {
      const double m = most[i / kLanes];
      moved[i] += random() % 2 == 0 ? uniform(random, -m, m) : (random() % 2 == 0 ? m : -m);
    }
    std::vector<float> span(arm.frames.size() * kLanes);
    for (std::size_t f = 0; f < arm.frames.size(); ++f) {
      const filter::Frame& frame = arm.frames[f];
      const double m = most[static_cast<std::size_t>(frame.joint)] * std::abs(frame.multiplier);
      std::fill_n(span.begin() + static_cast<std::ptrdiff_t>(f * kLanes), kLanes, round_up(m));
    }
    const Results at(kernel, {arm, q, span});
    const Results after(kernel, {arm, moved, span});
    for (std::size_t c = 0; c < arm.capsules.size(); ++c) {
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const auto end = [&](const Results& r, int i, float sign) {
          const std::size_t k = (c * 6 + static_cast<std::size_t>(i)) * kLanes + lane;
          return static_cast<double>(r.capsules[k] + sign * r.capsules[k + 3 * kLanes]);
        };
        const auto row = static_cast<std::size_t>(arm.capsules[c].motion_bounds_begin);
        const double bound = static_cast<double>(at.motion_bounds[row * kLanes + lane]);
        for (const float sign : {-1.0F, 1.0F}) {
          double square = 0.0;
          for (int i = 0; i < 3; ++i) {
            const double d = end(after, i, sign) - end(at, i, sign);
            square += d * d;
          }
          ASSERT_LE(std::sqrt(square), bound + 2e-6);
          if (bound > 0.05) tightest = std::max(tightest, std::sqrt(square) / bound);
        }
      }
    }
  }
  EXPECT_GE(tightest, 0.7);  // half of the true motion would be too little
}

}  // namespace
}  // namespace armloom::soundness
