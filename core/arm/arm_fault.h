#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>

#include "core/base/time.h"

namespace armloom {

// A fault of a simulated arm (FaultyArm), or of the link to its controller (FaultyLink).
struct ArmFault {
  enum class Kind {
    // ---- Of the arm and its controller ----
    stall,       // stops on its path, then continues
    slow,        // follows its path at `value` (0..1) of its speed
    late_start,  // starts each motion `value` seconds late
    // The controller gives up once: brakes and reports a fault, in the present or next motion.
    fault,
    // Commands still reach the arm, but no report comes back.
    drop_feedback,
    // Reports come with new numbers and times, but with the content of the last report before.
    freeze_feedback,
    // The first joint leaves its path, or the position where it rests, at `value` rad/s (m/s). A
    // brake ends this. The arm stays off the path until its next motion.
    drift,
    reject,   // rejects the next motion, once
    runaway,  // passes its authority and goes on to the end of the trajectory
    // Acknowledges brakes of category 1 and 2, but carries them out only when the fault ends.
    // Category 0 switches the drives off all the same.
    ignore_stop,
    noise,  // measured positions have Gaussian noise with standard deviation `value` (rad, m)
    // ---- Of the link ----
    delay,    // messages in both directions arrive `value` seconds late
    jitter,   // each message is late by a random time of up to `value` seconds; order is kept
    loss,     // each message is lost with probability `value`
    reorder,  // each message is overtaken by later ones with probability `value`
    // The connection is down, and messages under way are lost. The controller brakes.
    cut,
    // Like `cut`, but the controller also forgets its motion and its numbers. It comes back when
    // the fault is over and the arm rests.
    restart,
    clock_drift,  // the controller's clock gains `value` seconds per second
  };
  Kind kind;
  TimePoint from;
  std::optional<TimePoint> until;  // unlimited if nullopt
  double value = 0.0;

  [[nodiscard]] bool is_over(TimePoint now) const { return until && *until <= now; }
  [[nodiscard]] bool is_active(TimePoint now) const { return from <= now && !is_over(now); }
};

[[nodiscard]] constexpr bool is_of_link(ArmFault::Kind kind) {
  return kind >= ArmFault::Kind::delay;
}

// Something into which faults can be injected: a simulated controller or its connection.
class FaultTarget {
 public:
  virtual ~FaultTarget() = default;
  // Adds a fault under an unused `id`.
  virtual void inject(std::uint64_t id, ArmFault fault) = 0;
  // Returns false if there is no such fault.
  virtual bool remove(std::uint64_t id) = 0;
  // Returns the faults by id, except those that were removed or used up.
  [[nodiscard]] virtual std::map<std::uint64_t, ArmFault> faults() const = 0;
};

// Faults by id.
class FaultList {
 public:
  void add(std::uint64_t id, const ArmFault& fault) { faults_.insert_or_assign(id, fault); }
  bool remove(std::uint64_t id) { return faults_.erase(id) > 0; }
  [[nodiscard]] bool empty() const { return faults_.empty(); }
  [[nodiscard]] const std::map<std::uint64_t, ArmFault>& all() const { return faults_; }
  // Returns the first active fault of the kind; null if there is none.
  [[nodiscard]] const ArmFault* active(ArmFault::Kind kind, TimePoint now) const {
    for (const auto& [id, fault] : faults_) {
      if (fault.kind == kind && fault.is_active(now)) return &fault;
    }
    return nullptr;
  }
  // Removes the active faults of a kind that acts once.
  void use_up(ArmFault::Kind kind, TimePoint now) {
    std::erase_if(faults_, [&](const auto& entry) {
      return entry.second.kind == kind && entry.second.is_active(now);
    });
  }
  template <class Predicate>
  [[nodiscard]] bool any(const Predicate& predicate) const {
    return std::ranges::any_of(faults_, [&](const auto& entry) { return predicate(entry.second); });
  }

 private:
  std::map<std::uint64_t, ArmFault> faults_;
};

}  // namespace armloom
