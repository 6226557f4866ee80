#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/coordination/certificate.h"
#include "core/coordination/guard_refusal.h"
#include "core/model/cell.h"
#include "core/model/promises.h"

namespace armloom {

struct ArmPosition {
  TrajectoryPtr motion = {};  // null if the arm has not moved yet
  Duration measured{};        // progress proven by feedback
  Duration authority{};       // largest permitted progress; `measured` at rest
  bool at_rest = true;
  bool is_known = true;    // false: it may be anywhere
  double off_path = 0.0;   // largest distance of a joint from the path, at the last rest (rad, m)
  double left_path = 0.0;  // likewise, as measured since the last rest; zero within the tolerance

  [[nodiscard]] double error() const { return off_path > left_path ? off_path : left_path; }
};

// The last check before every start, resume and grant of authority (README.md). Invariants:
// - For every two arms, a valid certificate covers the product [measured, authority] x [measured,
//   authority], and this product overlaps none of the certificate's blocked rectangles.
// - Every motion has a valid certificate for the present scene.
//
// A certificate covers an arm on its motion, an arm at rest where the certificate says, and an arm
// at rest at the motion's start or end. Each certificate is a proof by itself, as long as its
// content hash is that of the present content. Pure; not thread-safe.
class AuthorityGuard {
 public:
  struct GuardedArm {
    std::vector<JointId> joints;                    // of the arm and its gripper
    Duration report_age = Promises::kReportAgeMin;  // Promises::report_age
  };
  // `arms`: by ArmId. `rest`: all joints of the cell.
  AuthorityGuard(std::vector<GuardedArm> arms, Configuration rest, SceneFingerprint present);

  // ---- Certificates and content ----
  void take(std::span<const Certificate> certificates);
  // Sets the present content (scene, attached objects). Certificates about other content are
  // ignored.
  void look_at(SceneFingerprint present) { present_ = std::move(present); }
  [[nodiscard]] const SceneFingerprint& scene() const { return present_; }
  // Forgets a motion that will not start again. The motion's certificates are dropped when no arm
  // is on the motion.
  void forget(const TrajectoryPtr& motion);

  // Reports a moving arm's progress, which never decreases.
  void moves(ArmId arm, Duration measured);
  // Reports the authority that a moving arm's controller acknowledges. The larger of granted and
  // acknowledged authority counts: a controller may have to raise it to where its brake ends.
  void acknowledges(ArmId arm, Duration authority);
  // Reports a resting arm: its progress, and all joints of the cell.
  void rests(ArmId arm, Duration progress, const Configuration& measured);

  // The arm may be anywhere until rests() is called for it. Only a proof that it cannot meet
  // another arm at all covers it.
  void forget_position(ArmId arm) { positions_[arm.index()].is_known = false; }
  // Reports that a moving arm was measured at this distance from its path (rad, m). Certificates
  // for a smaller error no longer cover the arm, until it rests.
  void leaves_path(ArmId arm, double distance);

  // Returns true if a certificate covers the present positions of the two arms up to their
  // authority.
  [[nodiscard]] bool certifies(ArmId arm, ArmId other) const;
  // Returns true if a certificate covers the arm's present motion in the present scene.
  [[nodiscard]] bool certifies_scene(ArmId arm) const;

  // Trajectory time at which a start or resume begins; nullopt for a grant to moving arms.
  using From = std::optional<Duration>;
  // Returns why the motion's arms may not move up to `authority`, or nullopt if they may.
  [[nodiscard]] std::optional<GuardRefusal> refuses(const TrajectoryPtr& motion, From from,
                                                    Duration authority) const;
  // Calls refuses() and, if permitted, records the arms' new positions. The caller then commands
  // the arms.
  [[nodiscard]] std::optional<GuardRefusal> grant(const TrajectoryPtr& motion, From from,
                                                  Duration authority);
  // Records the positions without a check, for policies that have no certificates.
  void hold(const TrajectoryPtr& motion, From from, Duration authority);
  [[nodiscard]] const ArmPosition& position(ArmId arm) const { return positions_[arm.index()]; }
  // Returns all joints of the cell, as last measured at rest.
  [[nodiscard]] const Configuration& rest() const { return q_; }
  // Returns the largest distance of a joint from the motion (rad, m).
  [[nodiscard]] double off_path(const TrajectoryPtr& motion, From from) const;

  // Limits: motions per arm, and certificates of one motion with one other arm and with the scene.
  // Beyond a limit the oldest are dropped, but no motion that an arm is on.
  inline static constexpr std::size_t kMotionsKept = 16, kPairsKept = 16, kScenesKept = 2;

 private:
  struct Known {  // certificates of one motion
    TrajectoryPtr motion;
    std::uint64_t taken_at = 0;
    bool is_forgotten = false;
    // By an arm of the other side. Side `a` of each certificate is this motion.
    std::map<ArmId, std::vector<PairCertificate>> pairs = {};
    std::vector<SceneCertificate> scene = {};
    std::optional<TogetherCertificate> together = {};
  };
  using Motions = std::unordered_map<const Trajectory*, Known>;  // Known keeps the key alive
  struct Interval {
    Duration from, to;
  };

  void take(const PairCertificate& pair);
  Known& known(const TrajectoryPtr& motion);
  void drop_left(const Trajectory* motion);
  void drop_old();
  [[nodiscard]] bool is_on(const Trajectory* motion) const;
  [[nodiscard]] bool is_valid(const PairCertificate& pair) const;
  [[nodiscard]] bool are_apart(ArmId a, ArmId b) const;
  [[nodiscard]] double off(const Trajectory& motion, ArmId arm, Duration progress) const;
  [[nodiscard]] ArmPosition as_granted(const TrajectoryPtr& motion, ArmId arm, From from,
                                       Duration authority) const;
  [[nodiscard]] std::optional<Interval> covers(const CertifiedSide& side, ArmId arm,
                                               const ArmPosition& position) const;
  [[nodiscard]] bool sees_scene(const Known& known, ArmId arm, const ArmPosition& own) const;
  [[nodiscard]] std::optional<GuardRefusal> between(const Known& known, ArmId arm,
                                                    const ArmPosition& own, ArmId other) const;
  [[nodiscard]] std::optional<GuardRefusal> together(const Known& known, Duration last,
                                                     Duration first) const;

  std::vector<GuardedArm> arms_;              // by ArmId
  std::vector<std::optional<ArmId>> arm_of_;  // by JointId
  Configuration q_;                           // joints as last measured at rest
  SceneFingerprint present_;
  std::vector<ArmPosition> positions_;  // by ArmId
  Motions motions_;
  std::map<std::pair<ArmId, ArmId>, Fingerprint> apart_;  // smaller id first
  std::uint64_t taken_ = 0;
};

}  // namespace armloom
