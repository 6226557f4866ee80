#include "core/geometry/mesh/convex_hull.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace armloom {
namespace {

using Points = std::vector<Eigen::Vector3d>;

struct Facet {
  std::array<std::uint32_t, 3> corners;  // indices of points, counter-clockwise from outside
  Eigen::Vector3d normal;                // outward, unit
  double offset;                         // normal . x + offset <= 0 inside
};
using Facets = std::vector<Facet>;

// qhull's error output, kept in memory.
class ErrorText {
 public:
  ErrorText() : file_(open_memstream(&text_, &size_)) {}
  ~ErrorText() {
    if (file_ != nullptr) std::fclose(file_);
    std::free(text_);
  }
  ErrorText(const ErrorText&) = delete;
  ErrorText& operator=(const ErrorText&) = delete;
  [[nodiscard]] FILE* file() const { return file_; }
  [[nodiscard]] std::string first_line() const {
    std::fflush(file_);
    const std::string text(text_ == nullptr ? "" : text_);
    return text.substr(0, text.find('\n'));
  }

 private:
  char* text_ = nullptr;
  std::size_t size_ = 0;
  FILE* file_;
};

Facets facets_of(qhT* qh) {
  Facets facets;
  facetT* facet = nullptr;
  FORALLfacets {
    Facet found{{}, Eigen::Vector3d(facet->normal), facet->offset};
    std::array<Eigen::Vector3d, 3> p;
    std::size_t i = 0;
    vertexT* vertex = nullptr;
    vertexT** vertexp = nullptr;
    FOREACHvertex_(facet->vertices) {
      if (i == 3) break;  // "Qt" makes every facet a triangle
      found.corners[i] = static_cast<std::uint32_t>(qh_pointid(qh, vertex->point));
      p[i++] = Eigen::Vector3d(vertex->point);
    }
    // qhull's corners are unordered.
    if ((p[1] - p[0]).cross(p[2] - p[0]).dot(found.normal) < 0.0) {
      std::swap(found.corners[1], found.corners[2]);
    }
    facets.push_back(found);
  }
  return facets;
}

tl::expected<Facets, std::string> run_qhull(const Points& points) {
  std::vector<coordT> flat;
  flat.reserve(3 * points.size());
  for (const Eigen::Vector3d& p : points) flat.insert(flat.end(), {p.x(), p.y(), p.z()});
  const ErrorText errors;
  if (errors.file() == nullptr) return tl::unexpected<std::string>("out of memory");
  qhT qhull;
  qh_zero(&qhull, errors.file());
  char options[] = "qhull Qt";
  const int code = qh_new_qhull(&qhull, 3, static_cast<int>(points.size()), flat.data(), False,
                                options, nullptr, errors.file());
  Facets facets;
  if (code == 0) facets = facets_of(&qhull);
  qh_freeqhull(&qhull, !qh_ALL);
  int kept_blocks = 0;
  int kept_bytes = 0;
  qh_memfreeshort(&qhull, &kept_blocks, &kept_bytes);
  if (code != 0) return tl::unexpected("qhull: " + errors.first_line());
  return facets;
}

// Returns the corners of a small cube around each point, or nullopt if the points do not lie within
// kFlat_m of a plane.
std::optional<Points> thickened(const Points& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) covariance += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d thin = solver.eigenvectors().col(0);
  double low = 0.0;
  double high = 0.0;
  for (const Eigen::Vector3d& p : points) {
    low = std::min(low, thin.dot(p - mean));
    high = std::max(high, thin.dot(p - mean));
  }
  if (high - low > kFlat_m) return std::nullopt;
  Points cubes;
  for (const Eigen::Vector3d& p : points) {
    for (int corner = 0; corner < 8; ++corner) {
      cubes.push_back(
          p + 0.5 * kFlat_m *
                  Eigen::Vector3d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
    }
  }
  return cubes;
}

// Returns 162 unit vectors: the corners of an icosahedron after halving all edges twice.
Points directions() {
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  Points corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-t, t}) {
      corners.emplace_back(0, a, b);
      corners.emplace_back(a, b, 0);
      corners.emplace_back(b, 0, a);
    }
  }
  std::vector<std::array<std::size_t, 3>> faces;
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        const auto near = [&](std::size_t a, std::size_t b) {
          return (corners[a] - corners[b]).norm() < 2.1;
        };
        if (near(i, j) && near(j, k) && near(i, k)) faces.push_back({i, j, k});
      }
    }
  }
  for (Eigen::Vector3d& corner : corners) corner.normalize();
  for (int round = 0; round < 2; ++round) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middle = [&](std::size_t a, std::size_t b) {
      const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), corners.size());
      if (is_new) corners.push_back((corners[a] + corners[b]).normalized());
      return it->second;
    };
    std::vector<std::array<std::size_t, 3>> halved;
    for (const auto& [a, b, c] : faces) {
      const std::size_t ab = middle(a, b);
      const std::size_t bc = middle(b, c);
      const std::size_t ca = middle(c, a);
      for (const auto& part : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
        halved.push_back(part);
      }
    }
    faces = std::move(halved);
  }
  return corners;
}

// Returns the corners of a polytope around the hull. It has a face for each of directions(), which
// touches the hull. The half space n . (x - inside) <= h of a face is the point n / h of a dual
// hull, and each facet of the dual hull is a corner of the polytope.
tl::expected<Points, std::string> corners_around(const Points& hull) {
  Eigen::Vector3d inside = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : hull) inside += p / static_cast<double>(hull.size());
  Points dual;
  for (const Eigen::Vector3d& n : directions()) {
    double h = 0.0;
    for (const Eigen::Vector3d& p : hull) h = std::max(h, n.dot(p - inside));
    dual.push_back(n / h);
  }
  const auto facets = run_qhull(dual);
  if (!facets) return tl::unexpected(facets.error());
  Points corners;
  for (const Facet& facet : *facets) corners.push_back(inside - facet.normal / facet.offset);
  return corners;
}

// Returns only the points used by facets.
Points corners_of(const Facets& facets, const Points& points) {
  std::set<std::uint32_t> used;
  for (const Facet& facet : facets) used.insert(facet.corners.begin(), facet.corners.end());
  Points corners;
  for (const std::uint32_t i : used) corners.push_back(points[i]);
  return corners;
}

ConvexHull hull_of(const Facets& facets, const Points& points) {
  ConvexHull hull;
  std::map<std::uint32_t, std::uint32_t> place;
  for (const Facet& facet : facets) {
    auto& face = hull.faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto next = static_cast<std::uint32_t>(hull.vertices.size());
      const auto [it, is_new] = place.try_emplace(facet.corners[i], next);
      if (is_new) hull.vertices.push_back(points[facet.corners[i]]);
      face[i] = it->second;
    }
  }
  return hull;
}

double farthest_outside(const Facets& facets, const Points& points) {
  double outside = -std::numeric_limits<double>::infinity();
  for (const Facet& facet : facets) {
    for (const Eigen::Vector3d& p : points) {
      outside = std::max(outside, facet.normal.dot(p) + facet.offset);
    }
  }
  return outside;
}

}  // namespace

tl::expected<ConvexHull, std::string> convex_hull(const std::vector<Eigen::Vector3d>& points) {
  const std::optional<Points> cubes = thickened(points);
  Points source = cubes ? *cubes : points;
  auto facets = run_qhull(source);
  if (!facets) return tl::unexpected(facets.error());
  Points corners = corners_of(*facets, source);
  if (corners.size() > kMaxHullVertices) {
    auto around = corners_around(corners);
    if (!around) return tl::unexpected(around.error());
    source = *std::move(around);
    facets = run_qhull(source);
    if (!facets) return tl::unexpected(facets.error());
  }
  const double outside = farthest_outside(*facets, points);
  if (!(outside <= kHullTolerance_m)) {
    return tl::unexpected("a vertex lies " + std::to_string(outside) + " m outside of the hull");
  }
  return hull_of(*facets, source);
}

double volume_m3(const ConvexHull& hull) {
  double sum = 0.0;
  for (const auto& face : hull.faces) {
    const Eigen::Vector3d a = hull.vertices[face[0]] - hull.vertices[0];
    const Eigen::Vector3d b = hull.vertices[face[1]] - hull.vertices[0];
    sum += a.dot(b.cross(hull.vertices[face[2]] - hull.vertices[0]));
  }
  return sum / 6.0;
}

}  // namespace armloom
