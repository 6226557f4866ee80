#pragma once

#include <optional>
#include <vector>

#include "core/precedence/passing_orders.h"

namespace armloom {

// The admitted motions of a cell with their passing orders, and the limits that follow from these.
// Invariant: for any two motions A and B with progress s and authority alpha, the rectangle [s_A,
// alpha_A] x [s_B, alpha_B] is certified free. So each motion may be late, slow or stopped, in any
// combination. The graph is acyclic after every admission, so every motion can reach its end. Pure.
class PrecedenceGraph {
 public:
  // Arms that rest in the path of the order's second motion, or will where the first one ends. The
  // region has only the boxes that the arms are in, and these do not end.
  struct Rest {
    std::vector<ArmId> arms;
    Precedence order;

    // Returns the progress up to which the second motion may go.
    [[nodiscard]] Duration limit() const { return *order.limit({}); }
    [[nodiscard]] Blocker blocker() const;  // names one of the arms
  };

  explicit PrecedenceGraph(std::size_t arms) : work_behind_(arms) {}

  [[nodiscard]] const std::vector<CoordinatedMotion>& motions() const { return motions_; }
  [[nodiscard]] const std::vector<Precedence>& precedences() const { return precedences_; }
  [[nodiscard]] const CoordinatedMotion* find(StepId step) const;
  [[nodiscard]] bool holds(StepId step) const { return find(step) != nullptr; }
  // Precondition: holds(step).
  [[nodiscard]] Duration horizon(StepId step) const { return find(step)->horizon; }

  // Sets the duration of the jobs that are not admitted, by ArmId. This affects only the choice of
  // orders.
  void set_work_behind(std::vector<Duration> work) { work_behind_ = std::move(work); }

  // Returns the question for Policy::decide(). The question holds references to all arguments and
  // to this graph.
  [[nodiscard]] OrderQuestion question(const std::vector<CoordinatedMotion>& candidates,
                                       const std::vector<PairRegions>& regions) const {
    return {motions_, precedences_, held_at(), candidates, regions, work_behind_};
  }
  void admit(const std::vector<CoordinatedMotion>& candidates, const PassingOrders& orders);

  // Sets the measured progress; never decreases.
  void progress(StepId step, Duration progress);
  // Returns the progress up to which the motion may go now, at most its duration. Zero while
  // another motion of its arms precedes it.
  [[nodiscard]] Duration limit(StepId step) const;
  // Returns what holds the motion at its limit; nullopt if it may go to its end, or if it only
  // waits for an earlier motion of its own arm.
  [[nodiscard]] std::optional<Blocker> held_back(StepId step) const;
  // Returns the first rest that holds the motion; nullopt if there is none. No admitted motion will
  // move these arms away.
  [[nodiscard]] std::optional<Rest> rests_ahead(StepId step) const;
  // Returns by motion the limit of rests_ahead().
  [[nodiscard]] HeldAt held_at() const;
  // Returns the precedences, with motions as indices into motions(), for predict().
  [[nodiscard]] std::vector<Dependency> dependencies() const;
  // Returns true if one of the arms rests, or will rest, in the motion's path.
  [[nodiscard]] bool is_held_by(StepId step, const std::vector<ArmId>& arms) const;
  // Returns true if the orders let all motions reach their ends. Ignores arms at rest in their
  // paths.
  [[nodiscard]] bool is_acyclic() const;
  // Records the authority sent to the arms. Throws std::logic_error if it exceeds limit().
  void granted(StepId step, Duration authority);
  // Sets the knowledge about a motion. Precondition: holds(step).
  void set_outlook(StepId step, const Outlook& outlook);
  void set_priority(StepId step, int priority);  // precondition: holds(step)

  // Remove a motion that has ended: at its goal (finish), or at another progress `rests_at`
  // (abandon). Motions that would pass an arm that now rests in their path stop before it until
  // that arm moves again. The arms of one motion may rest at different progress, from `rests_at` up
  // to `farthest`. Precondition of abandon: no admitted motion follows it on its arms.
  void finish(StepId step);
  void abandon(StepId step, Duration rests_at, Duration farthest = {});

 private:
  [[nodiscard]] std::size_t index_of(StepId step) const;  // precondition: holds(step)
  [[nodiscard]] std::optional<Rest> rest_in(const Precedence& order, StepId resting,
                                            const std::vector<ArmId>& arms, Duration at,
                                            Duration farthest) const;
  [[nodiscard]] std::optional<Duration> limit_by(const Precedence& order) const;
  [[nodiscard]] bool is_ahead(const Rest& rest) const;
  [[nodiscard]] std::optional<Rest> goal_in(const Precedence& order) const;
  [[nodiscard]] std::vector<Rest> rests_before(std::optional<StepId> step) const;
  void come_to_rest(StepId step, const std::vector<ArmId>& arms, Duration at, Duration farthest,
                    std::optional<std::size_t> brought_by = {});
  void erase(StepId step);

  std::vector<CoordinatedMotion> motions_;  // of one arm: in running order
  std::vector<Precedence> precedences_;
  std::vector<Rest> rests_;
  std::vector<Duration> work_behind_;
};

// Returns the blocker that says that the second motion waits for the first.
[[nodiscard]] Blocker blocker_of(const Precedence& precedence);

}  // namespace armloom
