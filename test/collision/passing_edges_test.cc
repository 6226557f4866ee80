// Compares coarse_leaves() with a literal implementation of its definition.
#include "core/collision/diagram/passing_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace armloom {
namespace {

using namespace std::chrono_literals;

constexpr PassingResolution kResolution{.fine = 2ms, .coarse = 16ms, .slope = 0.5};
constexpr ProgressBox kRemaining{5ms, 64ms, 3ms, 64ms};

std::vector<OpenLeaf> draw_leaves(std::mt19937& random) {
  std::vector<OpenLeaf> leaves;
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  const int wanted = 1 + below(24);
  for (int tried = 0; tried < 60 && static_cast<int>(leaves.size()) < wanted; ++tried) {
    const int width = 1 << below(5);
    const int a = width * below(static_cast<unsigned>(64 / width));
    const int b = width * below(static_cast<unsigned>(64 / width));
    const auto ms = [](int n) { return Duration(std::chrono::milliseconds(n)); };
    const ProgressBox box{ms(a), ms(a + width), ms(b), ms(b + width)};
    const bool covers = std::ranges::any_of(leaves, [&](const OpenLeaf& other) {
      return box.from_a < other.box.to_a && other.box.from_a < box.to_a &&
             box.from_b < other.box.to_b && other.box.from_b < box.to_b;
    });
    if (covers) continue;
    leaves.push_back({tried, box, below(4) != 0, below(3) == 0});
  }
  return leaves;
}

bool touch(const ProgressBox& x, const ProgressBox& y) {
  return x.from_a <= y.to_a && y.from_a <= x.to_a && x.from_b <= y.to_b && y.from_b <= x.to_b;
}

ProgressBox exchanged(const ProgressBox& box) {
  return {box.from_b, box.to_b, box.from_a, box.to_a};
}

std::vector<OpenLeaf> component_of(const OpenLeaf& leaf, const std::vector<OpenLeaf>& leaves) {
  std::vector<OpenLeaf> component{leaf};
  for (std::size_t i = 0; i < component.size(); ++i) {  // grows
    for (const OpenLeaf& other : leaves) {
      const bool known =
          std::ranges::find(component, other.cell, &OpenLeaf::cell) != component.end();
      if (!known && touch(component[i].box, other.box)) component.push_back(other);
    }
  }
  return component;
}

// Returns the allowed width of the component's first leaf if A passes first; nullopt if
// unrestricted.
std::optional<Duration> allowed_of(const std::vector<OpenLeaf>& component,
                                   const ProgressBox& remaining) {
  const ProgressBox& own = component.front().box;
  Duration certain = Duration::min() / 4;
  for (const OpenLeaf& other : component) {
    const ProgressBox& box = other.box;
    const bool ends_later = box.to_a > own.to_a && box.from_b <= own.from_b;
    const bool begins_sooner = box.to_a >= own.to_a && box.from_b < own.from_b;
    if (ends_later || begins_sooner) return std::nullopt;
    // The first of two leaves with the same corner is refined.
    const bool alike = box.to_a == own.to_a && box.from_b == own.from_b;
    if (alike &&
        std::tuple(box.from_a, other.cell) < std::tuple(own.from_a, component.front().cell)) {
      return std::nullopt;
    }
    if (!other.refinable) certain = std::max(certain, box.to_a - box.from_b);
    if (other.refinable && other.proven) {
      certain = std::max(certain, (box.from_a + box.to_a) / 2 - (box.from_b + box.to_b) / 2);
    }
  }
  if (own.to_a >= remaining.to_a || own.from_b <= remaining.from_b) return kResolution.fine;
  const Duration behind = std::max(Duration{}, certain - (own.to_a - own.from_b));
  return std::clamp(behind / 2, kResolution.fine, kResolution.coarse);
}

TEST(PassingEdges, CoarseLeavesMatchTheirDefinition) {
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const std::vector<OpenLeaf> leaves = draw_leaves(random);
    std::vector<CoarseLeaf> coarse = coarse_leaves(leaves, kRemaining, kResolution);
    std::ranges::sort(coarse, {}, &CoarseLeaf::cell);
    auto next = coarse.begin();
    for (const OpenLeaf& leaf : leaves) {
      if (!leaf.refinable) continue;
      std::vector<OpenLeaf> component = component_of(leaf, leaves);
      const auto a = allowed_of(component, kRemaining);
      for (OpenLeaf& other : component) other.box = exchanged(other.box);
      const auto b = allowed_of(component, exchanged(kRemaining));
      const Duration width = leaf.box.to_a - leaf.box.from_a;
      // A leaf at the current position must always be fine.
      const bool stands = leaf.box.from_a <= kRemaining.from_a &&
                          leaf.box.from_b <= kRemaining.from_b && width > kResolution.fine;
      const bool a_first = stands || (a && width > *a);
      const bool b_first = stands || (b && width > *b);
      if (!a_first && !b_first) continue;
      ASSERT_NE(next, coarse.end());
      EXPECT_EQ(next->cell, leaf.cell);
      EXPECT_EQ(next->a_first, a_first);
      EXPECT_EQ(next->b_first, b_first);
      EXPECT_LT(next->allowed, width);
      ++next;
      ++found;
    }
    ASSERT_EQ(next, coarse.end());
  }
  EXPECT_GT(found, 2000U) << "the drawn leaves say little";
}

}  // namespace
}  // namespace armloom
