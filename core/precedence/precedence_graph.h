#pragma once

#include <optional>
#include <vector>

#include "core/precedence/passing_orders.h"

namespace armloom {

// The admitted motions of a cell with the passing orders between them, and what follows from both:
// how far each may go. The invariant: for any two of them, with their progress s and authority
// alpha, the rectangle [s_A, alpha_A] x [s_B, alpha_B] is certified free; so any may be late, slow
// or stop, in any combination. The graph is acyclic after every admission, so that all come to
// their ends. Pure.
class PrecedenceGraph {
 public:
  explicit PrecedenceGraph(std::size_t arms) : work_behind_(arms) {}

  [[nodiscard]] const std::vector<CoordinatedMotion>& motions() const { return motions_; }
  [[nodiscard]] const std::vector<Precedence>& precedences() const { return precedences_; }
  [[nodiscard]] const CoordinatedMotion* find(JobId job) const;
  [[nodiscard]] bool holds(JobId job) const { return find(job) != nullptr; }
  // Precondition: it holds it.
  [[nodiscard]] Duration horizon(JobId job) const { return find(job)->horizon; }

  // By ArmId: the work that waits behind; only the choice between orders depends on it.
  void set_work_behind(std::vector<Duration> work) { work_behind_ = std::move(work); }

  // Who is to pass first where the candidates go beside what is admitted? Refers to all three.
  [[nodiscard]] OrderQuestion question(const std::vector<CoordinatedMotion>& candidates,
                                       const std::vector<PairRegions>& regions) const {
    return {motions_, precedences_, candidates, regions, work_behind_};
  }
  void admit(const std::vector<CoordinatedMotion>& candidates, const PassingOrders& orders);

  // What measurement proves; never goes back.
  void progress(JobId job, Duration progress);
  // How far precedence lets the motion go now; its duration, if nothing holds it. Zero while
  // another motion of one of its arms comes before it.
  [[nodiscard]] Duration limit(JobId job) const;
  // What holds it at its limit; nothing: it may go to its end, or waits for its own arm.
  [[nodiscard]] std::optional<Blocker> held_back(JobId job) const;
  // What rests in its way at its held_at, for good as things are; nothing: nothing does.
  [[nodiscard]] std::optional<Blocker> rests_ahead(JobId job) const;
  // Its precedences between its motions by their indices, for predict().
  [[nodiscard]] std::vector<Dependency> dependencies() const;
  // Whether one of the arms rests in the way of the motion.
  [[nodiscard]] bool is_held_by(JobId job, const std::vector<ArmId>& arms) const;
  // Whether all come to their ends by their orders, but for arms that rest in the way.
  [[nodiscard]] bool is_acyclic() const;
  // Told to the arm. No more than limit(): else throws std::logic_error.
  void granted(JobId job, Duration authority);
  // What is known of a motion besides its progress. Precondition: it holds it.
  void set_outlook(JobId job, const Outlook& outlook);
  void set_priority(JobId job, int priority);  // precondition: as above

  // The motion has ended: at its goal, or where it rests instead for good. In the latter case
  // motions that would pass there stay where they may be until its arm moves again. Of several arms
  // one may rest farther on the path than another.
  void finish(JobId job);
  void abandon(JobId job, Duration rests_at, Duration farthest = {});

 private:
  // Arms that came to rest on one motion in the way of an admitted one: until all have left.
  struct Blockade {
    std::vector<ArmId> arms;
    std::optional<JobId> goal_of;  // they will rest there when this one has come to its end
    JobId job;
    Duration limit;
    Duration until;    // beyond it the motion has passed
    Blocker evidence;  // names one of these arms

    void leave(const std::vector<ArmId>& left);
  };
  [[nodiscard]] CoordinatedMotion* motion(JobId job);
  [[nodiscard]] bool waits_for_own_arm(std::size_t index) const;
  struct Rest {
    std::vector<ArmId> arms;
    Duration at, farthest;  // arms of one motion may rest apart on it
    // Where it begins, when this one has brought them there. It has no regions with what comes
    // after it on another arm of its own; for that the regions with what was to leave count.
    const CoordinatedMotion* brought_by = nullptr;
  };
  [[nodiscard]] const Blockade* nearest_blockade(const CoordinatedMotion& motion) const;
  void block_others(const CoordinatedMotion& motion, const Rest& rest);
  void erase(JobId job);
  void tell_holds();

  std::vector<CoordinatedMotion> motions_;  // in order per arm
  std::vector<Precedence> precedences_;
  std::vector<Blockade> blockades_;
  std::vector<Duration> work_behind_;
};

// That the second waits for the first.
[[nodiscard]] Blocker blocker_of(const Precedence& precedence);

}  // namespace armloom
