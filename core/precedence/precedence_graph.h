#pragma once

#include <optional>
#include <vector>

#include "core/precedence/passing_orders.h"

namespace armloom {

// The admitted motions of a cell with their passing orders, and the resulting limits. Invariant:
// for any two motions with progress s and authority alpha, the rectangle [s_A, alpha_A] x [s_B,
// alpha_B] is certified free. So each motion may be late, slow or stopped, in any combination. The
// graph is acyclic after every admission, so every motion can reach its end. Pure.
class PrecedenceGraph {
 public:
  explicit PrecedenceGraph(std::size_t arms) : work_behind_(arms) {}

  [[nodiscard]] const std::vector<CoordinatedMotion>& motions() const { return motions_; }
  [[nodiscard]] const std::vector<Precedence>& precedences() const { return precedences_; }
  [[nodiscard]] const CoordinatedMotion* find(JobId job) const;
  [[nodiscard]] bool holds(JobId job) const { return find(job) != nullptr; }
  // Precondition: holds(job).
  [[nodiscard]] Duration horizon(JobId job) const { return find(job)->horizon; }

  // By ArmId: the work of jobs that are not admitted; affects only the choice of orders.
  void set_work_behind(std::vector<Duration> work) { work_behind_ = std::move(work); }

  // Returns the question for Policy::decide(). It refers to all arguments and to this graph.
  [[nodiscard]] OrderQuestion question(const std::vector<CoordinatedMotion>& candidates,
                                       const std::vector<PairRegions>& regions) const {
    return {motions_, precedences_, candidates, regions, work_behind_};
  }
  void admit(const std::vector<CoordinatedMotion>& candidates, const PassingOrders& orders);

  // Sets the measured progress; never decreases.
  void progress(JobId job, Duration progress);
  // Returns how far the motion may go now: at most its duration; zero while another motion of its
  // arms precedes it.
  [[nodiscard]] Duration limit(JobId job) const;
  // Returns what holds the motion at its limit; nullopt if it may go to its end or waits for its
  // own arm.
  [[nodiscard]] std::optional<Blocker> held_back(JobId job) const;
  // Returns the arm at rest at the motion's held_at, which stays there as planned; nullopt if there
  // is none.
  [[nodiscard]] std::optional<Blocker> rests_ahead(JobId job) const;
  // Returns the precedences between indices of motions(), for predict().
  [[nodiscard]] std::vector<Dependency> dependencies() const;
  // Returns true if one of the arms rests in the motion's path.
  [[nodiscard]] bool is_held_by(JobId job, const std::vector<ArmId>& arms) const;
  // Returns true if all motions reach their ends, not considering arms at rest in their paths.
  [[nodiscard]] bool is_acyclic() const;
  // Records the authority sent to the arms. Throws std::logic_error if it exceeds limit().
  void granted(JobId job, Duration authority);
  // Sets the knowledge about a motion. Precondition: holds(job).
  void set_outlook(JobId job, const Outlook& outlook);
  void set_priority(JobId job, int priority);  // precondition: as above

  // The motion has ended: at its goal (finish), or where it rests instead (abandon). After
  // abandon(), motions that would pass there stay before it until its arm moves again. The arms of
  // one motion may rest at different progress, up to `farthest`.
  void finish(JobId job);
  void abandon(JobId job, Duration rests_at, Duration farthest = {});

 private:
  // Arms that came to rest in the path of an admitted motion, until all of them have left.
  struct Blockade {
    std::vector<ArmId> arms;
    std::optional<JobId> goal_of;  // they will rest there when this motion has ended
    JobId job;
    Duration limit;
    Duration until;    // progress at which the motion has passed them
    Blocker evidence;  // names one of these arms

    void leave(const std::vector<ArmId>& left);
  };
  [[nodiscard]] CoordinatedMotion* motion(JobId job);
  [[nodiscard]] bool waits_for_own_arm(std::size_t index) const;
  struct Rest {
    std::vector<ArmId> arms;
    Duration at, farthest;  // the arms of one motion may rest apart on it
    // Set when the arms rest at this motion's start, having been moved there by `brought_by`. The
    // motion has no regions with later motions of those arms; the blockade is then derived from its
    // own regions with motions that share an arm with `brought_by`.
    const CoordinatedMotion* brought_by = nullptr;
  };
  [[nodiscard]] const Blockade* nearest_blockade(const CoordinatedMotion& motion) const;
  void block_others(const CoordinatedMotion& motion, const Rest& rest);
  void erase(JobId job);
  void tell_holds();

  std::vector<CoordinatedMotion> motions_;  // of one arm: in running order
  std::vector<Precedence> precedences_;
  std::vector<Blockade> blockades_;
  std::vector<Duration> work_behind_;
};

// Returns the blocker for the second motion, which waits for the first.
[[nodiscard]] Blocker blocker_of(const Precedence& precedence);

}  // namespace armloom
