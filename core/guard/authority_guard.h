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

namespace armloom {

// Where one arm is, and how far it may go: on a motion, or at rest.
struct ArmPosition {
  TrajectoryPtr motion = {};  // null: it has made none
  Duration measured{};        // progress that feedback proves
  Duration authority{};       // it may go so far; `measured` at rest
  bool at_rest = true;
  double off_path = 0.0;  // of its joints, where it set out or rests (rad, m)
};

// The last gate before every start, resume and grant of authority (README.md). It keeps this: for
// every two arms the product [measured, authority] x [measured, authority] is covered by a valid
// certificate and meets none of its rectangles, and every motion has one for the present scene.
//
// A certificate covers an arm that is on its motion, that rests where it says, or that rests where
// its motion begins or ends. Each one is a proof by itself, if its content is the present one's.
// README.md lists the assumptions. Pure; not thread-safe.
class AuthorityGuard {
 public:
  // By ArmId, the joints of each arm and of its gripper; where all joints of the cell are.
  AuthorityGuard(std::vector<std::vector<JointId>> joints, Configuration rest,
                 SceneFingerprint present);

  // ---- What is known ----
  void take(std::span<const Certificate> certificates);
  // The scene, or what arms hold, is another one: certificates that name what changed do not count.
  void look_at(SceneFingerprint present) { present_ = std::move(present); }
  [[nodiscard]] const SceneFingerprint& scene() const { return present_; }
  // The motion will not be started any more: its certificates go when no arm is on it.
  void forget(const TrajectoryPtr& motion);

  // ---- Feedback ----
  // The arm is on its motion. Progress never goes back.
  void moves(ArmId arm, Duration measured);
  // The arm is at rest, `progress` on its motion; `measured`: all joints of the cell.
  void rests(ArmId arm, Duration progress, const Configuration& measured);

  // ---- The gate ----
  // Trajectory time where a start or resume begins; nullopt for a grant to arms under way.
  using From = std::optional<Duration>;
  // Returns why the motion's arms may not go up to `authority`; nullopt if they may.
  [[nodiscard]] std::optional<GuardRefusal> refuses(const TrajectoryPtr& motion, From from,
                                                    Duration authority) const;
  // The same, and holds their positions if they may. The caller then tells the arms.
  [[nodiscard]] std::optional<GuardRefusal> grant(const TrajectoryPtr& motion, From from,
                                                  Duration authority);
  // Holds their positions without certificates, for policies that have none.
  void hold(const TrajectoryPtr& motion, From from, Duration authority);
  [[nodiscard]] const ArmPosition& position(ArmId arm) const { return positions_[arm.index()]; }
  // The joints of the whole cell, as last seen at rest.
  [[nodiscard]] const Configuration& rest() const { return q_; }
  // Returns the largest distance between a joint of the motion's arms and the motion (rad, m).
  [[nodiscard]] double off_path(const TrajectoryPtr& motion, From from) const;

  // The latest certificates are kept: of so many motions for each arm while no arm is on them; and
  // of each motion so many with one other arm, and with the scene.
  inline static constexpr std::size_t kMotionsKept = 16, kPairsKept = 16, kScenesKept = 2;

 private:
  struct Known {  // of one motion
    TrajectoryPtr motion;
    std::uint64_t taken_at = 0;
    bool is_forgotten = false;
    // By arm of the other side; the motion's own side is `a`.
    std::map<ArmId, std::vector<PairCertificate>> pairs = {};
    std::vector<SceneCertificate> scene = {};
    std::optional<TogetherCertificate> together = {};
  };
  using Motions = std::unordered_map<const Trajectory*, Known>;  // alive: an address is an identity
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

  std::vector<std::vector<JointId>> joints_;  // by ArmId
  std::vector<std::optional<ArmId>> arm_of_;  // by JointId
  Configuration q_;                           // where joints were last seen at rest
  SceneFingerprint present_;
  std::vector<ArmPosition> positions_;  // by ArmId
  Motions motions_;
  std::map<std::pair<ArmId, ArmId>, Fingerprint> apart_;  // smaller id first
  std::uint64_t taken_ = 0;
};

}  // namespace armloom
