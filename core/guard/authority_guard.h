#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/coordination/certificate.h"
#include "core/model/cell.h"

namespace armloom {

// Evidence that an arm must not be given authority.
struct GuardRefusal {
  enum class Why {
    uncertified,  // no valid certificate covers it: ask the checker for one
    region,       // a certificate covers it, and the product of authorities meets a region
    busy,         // the arm is on another motion
    out_of_step,  // the arms of the motion are farther apart on it than is certified
  };
  Why why = Why::uncertified;
  ArmId arm{0};                     // that may not go
  std::optional<ArmId> other = {};  // nullopt: the scene, or the arms of the same motion
  ProgressBox asked = {};           // progress of `arm`, progress of `other`, up to authority
  std::optional<ProgressBox> region = {};  // Why::region: the first rectangle that is met
};
[[nodiscard]] constexpr const char* to_string(GuardRefusal::Why why) {
  switch (why) {
    case GuardRefusal::Why::uncertified:
      return "uncertified";
    case GuardRefusal::Why::region:
      return "region";
    case GuardRefusal::Why::busy:
      return "busy";
    case GuardRefusal::Why::out_of_step:
      return "out_of_step";
  }
  return nullptr;
}

// Where one arm is, and how far it may go: on a motion, or at rest.
struct ArmPosition {
  TrajectoryPtr motion = {};  // null: it has made none
  Duration measured{};        // progress that feedback proves
  Duration authority{};       // it may go so far; `measured` at rest
  bool at_rest = true;
  double off_path = 0.0;  // of its joints, where it set out (rad, m)
};

// The last gate before every start, resume and grant of authority. It holds certificates and the
// positions of the arms, and knows no jobs, orders or policies, so that a scheduler that errs costs
// a refusal and never a contact. The invariant that it keeps: for every two arms the product
// [measured, authority] x [measured, authority] is covered by a valid certificate and meets none
// of its rectangles, and every motion has a valid certificate for all objects of the scene.
//
// A position is matched with a certificate by what it is: on the same motion; at rest where that
// says; or at rest where its motion begins or ends. Each certificate that covers a pair is a proof
// by itself. Certificates of other content (SceneFingerprint) than the present one do not count.
//
// Assumes that joints stay within `error` of their paths, that arms brake by themselves so that
// they rest at their authority, and that feedback is true. Pure; not thread-safe.
class AuthorityGuard {
 public:
  // By ArmId, the joints of each arm and of its gripper; where all joints of the cell are.
  AuthorityGuard(std::vector<std::vector<JointId>> joints, Configuration rest,
                 SceneFingerprint present);

  // ---- What is known ----
  void take(std::span<const Certificate> certificates);
  // The scene, or what arms hold, is another one: certificates that name what changed do not count.
  void look_at(SceneFingerprint present) { present_ = std::move(present); }
  // The motion will not be started any more: its certificates go when no arm is on it.
  void forget(const TrajectoryPtr& motion);

  // ---- Feedback ----
  // The arm is on its motion. Progress never goes back.
  void moves(ArmId arm, Duration measured);
  // The arm is at rest, `progress` on its motion; `measured`: all joints of the cell.
  void rests(ArmId arm, Duration progress, const Configuration& measured);

  // ---- The gate ----
  // Returns why the motion's arms may not go from where they are (at the start: `from`) up to
  // `authority`; nullopt if they may. Trajectory time.
  [[nodiscard]] std::optional<GuardRefusal> refuses(const TrajectoryPtr& motion, Duration from,
                                                    Duration authority) const;
  // The same, and holds their positions if they may. The caller then tells the arms.
  [[nodiscard]] std::optional<GuardRefusal> grant(const TrajectoryPtr& motion, Duration from,
                                                  Duration authority);
  // Holds their positions without certificates, for policies that have none.
  void hold(const TrajectoryPtr& motion, Duration from, Duration authority);
  [[nodiscard]] const ArmPosition& position(ArmId arm) const { return positions_[arm.index()]; }
  // The joints of the whole cell, as last seen at rest.
  [[nodiscard]] const Configuration& rest() const { return q_; }
  // How far the arms of the motion are from it where they are, at the start `from` (rad, m).
  [[nodiscard]] double off_path(const TrajectoryPtr& motion, Duration from) const;

  // So many motions for each arm keep their certificates while no arm is on them, the latest.
  inline static constexpr std::size_t kMotionsKept = 16;
  // So many certificates of each motion are kept with one other arm, and with the scene.
  inline static constexpr std::size_t kPairsKept = 16, kScenesKept = 2;

 private:
  using PairPtr = std::shared_ptr<const PairCertificate>;
  struct Known {  // of one motion
    TrajectoryPtr motion;
    std::uint64_t taken_at = 0;
    bool is_forgotten = false;
    std::map<ArmId, std::vector<PairPtr>> pairs = {};  // by arm of the other side
    std::vector<SceneCertificate> scene = {};
    std::optional<TogetherCertificate> together = {};
  };
  struct Interval {
    Duration from, to;
  };
  // What a set of certificates says of a product.
  struct Answer {
    bool covered = false, free = false;
    Interval other{};
    std::optional<ProgressBox> met = {};
  };

  void take(const PairCertificate& pair);
  Known& known(const TrajectoryPtr& motion);
  void drop(std::unordered_map<const Trajectory*, Known>::iterator known);
  void drop_old();
  [[nodiscard]] bool is_on(const Trajectory* motion) const;
  [[nodiscard]] bool is_valid(const CertifiedSide& a, const CertifiedSide* b,
                              Fingerprint geometry) const;
  [[nodiscard]] double off(const Trajectory& motion, ArmId arm, Duration progress) const;
  [[nodiscard]] ArmPosition as_granted(const TrajectoryPtr& motion, ArmId arm, Duration from,
                                       Duration authority) const;
  [[nodiscard]] std::optional<Interval> covers(const CertifiedSide& side, ArmId arm,
                                               const ArmPosition& position) const;
  [[nodiscard]] bool sees_scene(const Known& known, ArmId arm, const ArmPosition& own) const;
  [[nodiscard]] Answer between(const Known& known, ArmId arm, const ArmPosition& own,
                               ArmId other) const;

  std::vector<std::vector<JointId>> joints_;  // by ArmId
  std::vector<std::optional<ArmId>> arm_of_;  // by JointId
  Configuration q_;                           // where joints were last seen at rest
  SceneFingerprint present_;
  std::vector<ArmPosition> positions_;  // by ArmId
  std::unordered_map<const Trajectory*, Known>
      motions_;  // keeps them alive: an address is an identity
  std::map<std::pair<ArmId, ArmId>, Fingerprint> apart_;  // smaller id first
  std::uint64_t taken_ = 0;
};

}  // namespace armloom
