#include "core/planning/shorten.h"

#include <algorithm>
#include <random>

namespace armloom {
namespace {

using Points = std::vector<Eigen::VectorXd>;

// Leaves out points that are not needed: after each kept point, keeps the farthest point that a
// free line reaches.
void leave_out(Points& points, const Shortening& by) {
  Points kept{points.front()};
  for (std::size_t from = 0; from + 1 < points.size();) {
    std::size_t to = points.size() - 1;
    while (to > from + 1 && (by.stop() || !by.is_free(points[from], points[to]))) --to;
    kept.push_back(points[to]);
    from = to;
  }
  points = std::move(kept);
}

struct Place {
  std::size_t segment;
  Eigen::VectorXd q;
};

Place place_at(const Points& points, double length) {
  for (std::size_t i = 0;; ++i) {
    const double chord = (points[i + 1] - points[i]).norm();
    if (length <= chord || i + 2 == points.size()) {
      const double share = chord > 0.0 ? std::min(1.0, length / chord) : 0.0;
      return {i, points[i] + share * (points[i + 1] - points[i])};
    }
    length -= chord;
  }
}

}  // namespace

double length_of(const std::vector<Eigen::VectorXd>& points) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) length += (points[i + 1] - points[i]).norm();
  return length;
}

void shorten(Points& points, const Shortening& by) {
  leave_out(points, by);
  std::mt19937_64 random(by.seed);
  const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  constexpr int kFailuresMax = 25;
  int failures = 0;
  for (int i = 0; i < by.tries && points.size() > 2 && failures < kFailuresMax; ++i) {
    if (by.stop()) return;
    const double whole = length_of(points);
    const double one = share() * whole;
    const double other = share() * whole;
    const Place from = place_at(points, std::min(one, other));
    const Place to = place_at(points, std::max(one, other));
    ++failures;
    if (from.segment == to.segment || !by.is_free(from.q, to.q)) continue;
    const auto at = [&](std::size_t k) { return points.begin() + static_cast<std::ptrdiff_t>(k); };
    Points next(points.begin(), at(from.segment + 1));
    next.push_back(from.q);
    next.push_back(to.q);
    next.insert(next.end(), at(to.segment + 1), points.end());
    if (whole - length_of(next) > 0.01 * whole) failures = 0;
    points = std::move(next);
  }
  // Leave out points that random lines made unnecessary.
  leave_out(points, by);
}

}  // namespace armloom
