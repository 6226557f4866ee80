#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/ids.h"
#include "core/base/time.h"
#include "core/coordination/conflict_region.h"
#include "core/trajectory/trajectory.h"

namespace armloom {

// Certificates: what the checker has proven, as values. Each is complete by itself, so that it
// stays true whatever becomes of the question that it answered.

// A content hash of everything that a proof relies on besides the motions: shapes, where they are,
// what arms hold, pairs that are not looked at, and the distances that are kept.
using Fingerprint = std::uint64_t;

// The content of a planning scene.
struct SceneFingerprint {
  Fingerprint common = 0;         // limits, pairs that may touch, links that no arm moves
  std::vector<Fingerprint> arms;  // by ArmId: links, joints, and what the arm holds
  // By ArmId: the objects within the arm's reach, ascending.
  std::vector<std::vector<Fingerprint>> objects;

  // Returns the content that a proof about the arms of both lists relies on. Precondition: each
  // list is ascending, and no arm is in both.
  [[nodiscard]] Fingerprint of(std::span<const ArmId> one, std::span<const ArmId> other = {}) const;
  bool operator==(const SceneFingerprint&) const = default;
};
// Returns the arms whose motions have to be checked again: an object appeared or changed within
// their reach, or any arm, or what all proofs rely on, is different.
[[nodiscard]] std::vector<ArmId> arms_in_question(const SceneFingerprint& before,
                                                  const SceneFingerprint& now);

// The arms of one motion, or one arm at rest, as a proof sees them. Each joint is at most `error`
// (rad, m) from where it is said to be.
struct CertifiedSide {
  std::vector<ArmId> arms;  // ascending
  TrajectoryPtr motion;     // null: the arm is at rest
  Duration from{};          // the proof holds from this progress of the motion on
  double error = 0.0;
  std::vector<std::pair<JointId, double>> still;  // positions of their joints that do not move
};

// Wherever both are on their ways, they keep their clearance, but for these rectangles: progress of
// `a`, progress of `b` (zero at rest). An edge is free unless another rectangle, or the motion's
// own end, lies behind it.
struct PairCertificate {
  CertifiedSide a;
  CertifiedSide b;
  std::vector<ProgressBox> blocked;
  Fingerprint geometry;
};
[[nodiscard]] PairCertificate turned(const PairCertificate& pair);
// These two arms keep their clearance wherever they are.
struct ApartCertificate {
  ArmId a;
  ArmId b;
  Fingerprint geometry;
};
// On all of its remaining way the motion keeps its clearance from itself, links that stand still,
// and these objects.
struct SceneCertificate {
  CertifiedSide side;
  std::vector<std::vector<Fingerprint>> objects;  // of each arm of the side, ascending
  Fingerprint geometry;
};
// The arms of one motion keep their clearance from each other while none of them is ahead of
// another by more than `apart` (trajectory time).
struct TogetherCertificate {
  CertifiedSide side;
  Duration apart;
  Fingerprint geometry;
};
using Certificate =
    std::variant<PairCertificate, ApartCertificate, SceneCertificate, TogetherCertificate>;

}  // namespace armloom
