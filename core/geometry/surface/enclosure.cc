#include "core/geometry/surface/enclosure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace armloom {
namespace {

using Eigen::Array4f;
using Eigen::Vector3d;

// Arbitrary directions, so that faces of robots are unlikely to be parallel to a ray.
const std::array<Vector3d, 12> kRays = {{{0.8365, 0.4127, 0.3613},
                                         {-0.3119, 0.8741, -0.3724},
                                         {0.2371, -0.4509, 0.8606},
                                         {-0.7302, -0.5847, 0.3539},
                                         {0.1637, 0.3391, -0.9264},
                                         {0.5813, -0.7716, -0.2583},
                                         {-0.9021, 0.2158, 0.3737},
                                         {-0.1948, -0.8893, -0.4138},
                                         {0.6409, 0.1283, -0.7568},
                                         {-0.4471, 0.3812, 0.8092},
                                         {0.1219, 0.9318, 0.3418},
                                         {-0.5237, -0.2411, -0.8171}}};
constexpr double kDoubt = 1e-12;     // relative: the sign of a smaller value is uncertain
constexpr std::size_t kMost = 64;    // most crossings of one ray
constexpr std::size_t kDepth = 128;  // stack size: the tree's depth is logarithmic

enum class Hit { no, from_behind, from_front, doubtful };

// Returns if the ray from the origin along n crosses the triangle t, and from which side.
Hit hit_of(const Vector3d& n, const std::array<Vector3d, 3>& t) {
  double side[3];
  bool any_positive = false;
  bool any_negative = false;
  bool clear = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& a = t[i];
    const Vector3d& b = t[(i + 1) % 3];
    side[i] = n.dot(a.cross(b));
    const double doubt = kDoubt * (a.norm() * b.norm());
    any_positive = any_positive || side[i] > doubt;
    any_negative = any_negative || side[i] < -doubt;
    clear = clear && std::abs(side[i]) > doubt;
  }
  if (any_positive && any_negative) return Hit::no;
  // The ray's line may cross the triangle. The crossing is then between the corners, as seen along
  // n.
  const double along[3] = {n.dot(t[0]), n.dot(t[1]), n.dot(t[2])};
  if (along[0] < 0.0 && along[1] < 0.0 && along[2] < 0.0) return Hit::no;
  if (!clear) return Hit::doubtful;
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double rise = n.dot(normal);
  const double height = normal.dot(t[0]);
  const double size = normal.norm();
  if (std::abs(rise) <= kDoubt * size || std::abs(height) <= kDoubt * size * t[0].norm()) {
    return Hit::doubtful;
  }
  if ((height > 0.0) != (rise > 0.0)) return Hit::no;
  return rise > 0.0 ? Hit::from_behind : Hit::from_front;
}

// Returns for each box of the node if the ray from p may meet this box. A slab test; `slack_m`
// covers the rounding to float.
Eigen::Array<bool, 4, 1> may_meet(const SurfaceTree::Node& node, const Vector3d& p,
                                  const Vector3d& inverse, float slack_m) {
  Array4f from = Array4f::Zero();
  Array4f to = Array4f::Constant(std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto per_m = static_cast<float>(inverse[axis]);
    const Array4f middle = (node.center[k] - static_cast<float>(p[axis])) * per_m;
    const Array4f half = (node.half[k] + slack_m) * std::abs(per_m);
    from = from.max(middle - half);
    to = to.min(middle + half);
  }
  return from <= to;
}

struct Crossing {
  std::uint32_t component;
  std::uint32_t triangle;
  int turn;
};

struct Crossings {
  std::array<Crossing, kMost> all;
  std::size_t count = 0;
  bool doubtful = false;
};

// Adds the ray's crossing with the triangle, if any. Returns false if the crossing is uncertain, or
// if the ray crosses more than kMost triangles.
bool add_crossing(const SurfaceTree& tree, std::uint32_t triangle, const Vector3d& p,
                  const Vector3d& n, Crossings& crossings) {
  const Triangle& t = tree.triangles[triangle];
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;  // no area
  auto corners = tree.corners(triangle);
  for (Vector3d& corner : corners) corner -= p;
  const Hit hit = hit_of(n, corners);
  if (hit == Hit::no) return true;
  if (hit == Hit::doubtful || crossings.count == kMost) return false;
  crossings.all[crossings.count++] = {tree.component_of[triangle], triangle,
                                      hit == Hit::from_behind ? 1 : -1};
  return true;
}

Crossings cross(const SurfaceTree& tree, const Vector3d& p, const Vector3d& n) {
  Crossings crossings;
  const Vector3d inverse = n.cwiseInverse();
  const float slack_m =
      16.0F * std::numeric_limits<float>::epsilon() * static_cast<float>(tree.reach_m + p.norm());
  std::array<std::uint32_t, kDepth> stack;
  std::size_t open = 0;
  stack[open++] = tree.root.below;
  while (open > 0) {
    const SurfaceTree::Node& node = tree.nodes[stack[--open]];
    const auto met = may_meet(node, p, inverse, slack_m);
    for (std::size_t i = 0; i < 4; ++i) {
      if (!met[static_cast<Eigen::Index>(i)]) continue;
      if (!node.leaf[i]) {
        stack[open++] = node.below[i];
      } else if (!add_crossing(tree, node.below[i], p, n, crossings)) {
        crossings.doubtful = true;
        return crossings;
      }
    }
  }
  return crossings;
}

enum class Answer { outside, enclosed, open };

// Returns the answer of a ray whose crossings are all certain. The answer is `open` if only
// components of inconsistent orientation might enclose the point.
Answer answer_of(const SurfaceTree& tree, Crossings& crossings) {
  const auto begin = crossings.all.begin();
  const auto place = [](const Crossing& c) { return std::pair(c.component, c.triangle); };
  std::sort(begin, begin + static_cast<std::ptrdiff_t>(crossings.count),
            [&](const Crossing& a, const Crossing& b) { return place(a) < place(b); });
  // A triangle that several leaves share may be listed several times.
  const auto end =
      std::unique(begin, begin + static_cast<std::ptrdiff_t>(crossings.count),
                  [](const Crossing& a, const Crossing& b) { return a.triangle == b.triangle; });
  Answer answer = Answer::outside;
  for (auto at = crossings.all.begin(); at != end;) {
    const std::uint32_t component = at->component;
    int turns = 0;
    int count = 0;
    for (; at != end && at->component == component; ++at, ++count) turns += at->turn;
    const bool oriented = tree.components[component].oriented;
    if (count % 2 != 0 || (oriented && turns != 0)) return Answer::enclosed;
    if (!oriented) answer = Answer::open;
  }
  return answer;
}

}  // namespace

bool may_enclose(const SurfaceTree& tree, const Eigen::Vector3d& p_T) {
  if (!tree.encloses) return false;
  for (const Vector3d& n : kRays) {
    Crossings crossings = cross(tree, p_T, n);
    if (crossings.doubtful) continue;
    const Answer answer = answer_of(tree, crossings);
    if (answer != Answer::open) return answer == Answer::enclosed;
  }
  return true;
}

}  // namespace armloom
