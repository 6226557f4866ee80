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

// Certificates: proofs of the checker, as self-contained values.

// Content hash of everything on which a proof relies, except motions: shapes, poses, attached
// objects, pairs that are not checked, required distances.
using Fingerprint = std::uint64_t;

// The content of a planning scene.
struct SceneFingerprint {
  Fingerprint common = 0;         // limits, pairs that may touch, links that no arm moves
  std::vector<Fingerprint> arms;  // by ArmId: links, joints, attached objects
  // By ArmId: the objects within the arm's reach, ascending.
  std::vector<std::vector<Fingerprint>> objects;

  // Returns the hash of the content on which a proof about these arms relies. Precondition: each
  // list is ascending, and no arm is in both lists.
  [[nodiscard]] Fingerprint of(std::span<const ArmId> one, std::span<const ArmId> other = {}) const;
  bool operator==(const SceneFingerprint&) const = default;
};
// Returns the arms whose motions must be checked again. These are the arms with a new or changed
// object within reach, or all arms if an arm or the common content changed.
[[nodiscard]] std::vector<ArmId> arms_in_question(const SceneFingerprint& before,
                                                  const SceneFingerprint& now);

// One side of a proof: the arms of one motion, or one resting arm. The proof assumes that each
// joint is at most its arm's error (rad, m) from its position on the motion or at rest.
struct CertifiedSide {
  std::vector<ArmId> arms;                        // ascending
  TrajectoryPtr motion;                           // null if the arm rests
  Duration from{};                                // valid from this progress on
  std::vector<double> errors = {};                // by index in `arms`
  std::vector<std::pair<JointId, double>> still;  // positions of the arms' joints that do not move

  // Returns the error of one of the arms; zero for any other arm.
  [[nodiscard]] double error_of(ArmId arm) const;
};

// Proves that two sides keep their clearance at all combinations of positions on their motions,
// except in the rectangles `blocked`. A rectangle is an interval of the progress of `a` and an
// interval of the progress of `b`; the progress of a resting side is zero. The edge of a rectangle
// is free unless it is also the edge of another rectangle or at the end of a motion.
struct PairCertificate {
  CertifiedSide a;
  CertifiedSide b;
  std::vector<ProgressBox> blocked;
  Fingerprint geometry;
};
[[nodiscard]] PairCertificate turned(const PairCertificate& pair);
// Proves that two arms keep their clearance in all their positions.
struct ApartCertificate {
  ArmId a;
  ArmId b;
  Fingerprint geometry;
};
// Proves that the side's motion, from the progress side.from on, keeps its clearance from the
// side's own links, from stationary links and from these objects.
struct SceneCertificate {
  CertifiedSide side;
  std::vector<std::vector<Fingerprint>>
      objects;  // by index in side.arms; hashes in ascending order
  Fingerprint geometry;
};
// Proves that a motion's arms keep their clearance from each other while no arm is ahead of another
// by more than `apart` (trajectory time).
struct TogetherCertificate {
  CertifiedSide side;
  Duration apart;
  Fingerprint geometry;
};
using Certificate =
    std::variant<PairCertificate, ApartCertificate, SceneCertificate, TogetherCertificate>;

}  // namespace armloom
