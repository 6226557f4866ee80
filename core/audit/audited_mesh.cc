#include "core/audit/audited_mesh.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

#include "core/audit/triangle_model.h"

namespace armloom {
namespace {

// Union-find: vertices of one set are connected by triangles.
class Pieces {
 public:
  explicit Pieces(std::size_t vertices) : above_(vertices) {
    std::iota(above_.begin(), above_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { above_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> above_;
};

// Returns true if a ray from p crosses the triangle (Möller and Trumbore 1997).
bool crosses(const Eigen::Vector3d& p, const Eigen::Vector3d& ray, const Eigen::Vector3d& a,
             const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d normal = ray.cross(ac);
  const double det = ab.dot(normal);
  if (det == 0.0) return false;
  const Eigen::Vector3d ap = p - a;
  const double u = ap.dot(normal) / det;
  if (!(u >= 0.0 && u <= 1.0)) return false;
  const Eigen::Vector3d across = ap.cross(ab);
  const double v = ray.dot(across) / det;
  return v >= 0.0 && u + v <= 1.0 && ac.dot(across) / det > 0.0;
}

}  // namespace

AuditedMesh::AuditedMesh(const MeshData& mesh) : vertices_(mesh.vertices) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : vertices_) box.extend(p);
  p_SC_ = box.center();
  for (Eigen::Vector3d& p : vertices_) {
    p -= p_SC_;
    radius_m_ = std::max(radius_m_, p.norm());
  }
  Pieces connected(vertices_.size());
  for (const Triangle& t : mesh.triangles) {
    connected.join(t[0], t[1]);
    connected.join(t[1], t[2]);
  }
  std::map<std::uint32_t, Piece> pieces;
  for (const Triangle& t : mesh.triangles) {
    Piece& piece = pieces[connected.root(t[0])];
    for (const std::uint32_t i : t) piece.box.extend(vertices_[i]);
    piece.triangles.push_back(t);
  }
  for (auto& [root, piece] : pieces) pieces_.push_back(std::move(piece));
  std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
    return a.triangles.size() > b.triangles.size();
  });
  for (std::size_t i = 0; i < std::min(pieces_.size(), kMaxRepresentatives); ++i) {
    representatives_.push_back(vertices_[pieces_[i].triangles.front()[0]]);
  }
}

std::shared_ptr<fcl::CollisionGeometryd> AuditedMesh::make_surface() const {
  TriangleModel model{vertices_, {}};
  for (const Piece& piece : pieces_) {
    model.triangles.insert(model.triangles.end(), piece.triangles.begin(), piece.triangles.end());
  }
  return model.made();
}

bool AuditedMesh::crosses_odd(const Piece& piece, const Eigen::Vector3d& p,
                              const Eigen::Vector3d& ray) const {
  bool odd = false;
  for (const Triangle& t : piece.triangles) {
    odd ^= crosses(p, ray, vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
  }
  return odd;
}

bool AuditedMesh::encloses(const Eigen::Vector3d& p_C) const {
  static const Eigen::Vector3d kRays[] = {
      {0.8365, 0.4127, 0.3613}, {-0.3119, 0.8741, -0.3724}, {0.2371, -0.4509, 0.8606}};
  return std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
    if (!piece.box.contains(p_C)) return false;
    int votes = 0;
    for (const Eigen::Vector3d& ray : kRays) votes += crosses_odd(piece, p_C, ray) ? 1 : 0;
    return votes >= 2;
  });
}

}  // namespace armloom
