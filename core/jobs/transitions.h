#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/jobs/state.h"

namespace armloom {

// Transitions of jobs, with all their consequences for arm queues, orders, rests, the safe
// sequence, versions and effects. The rules of the scheduler decide, and call these.
class Transitions : public StateWriter {
 public:
  using StateWriter::StateWriter;

  // ---- Jobs that come and end

  // Adds a job at the end of its arm queues, or before the job Errand::before. `errand`: of a job
  // of the server.
  const Step& add(const Submit& job, const std::optional<Errand>& errand = {});
  // Adds jobs whose motions are under way, and admits them without a check.
  void put_under_way(const std::vector<Motion>& motions,
                     const std::vector<CoordinatedMotion>& admitted);
  // Ends the job. Jobs that name it in `after` no longer wait for it, or fail if it did not
  // succeed.
  void end(const Step& step, JobState how, Reason reason, std::string detail);
  // The server ends: interrupts all jobs, or with `keeps_waiting` only those that have begun.
  void interrupt(bool keeps_waiting);
  // Cancels or fails the job (`then` is not `hold`), at once or after braking.
  void give_up(const Step& step, const AfterStop& after);

  // ---- Motions

  // Admits the steps with these orders. `candidates`: the motion of each step, in the same order.
  void admit(const std::vector<StepId>& steps, const std::vector<CoordinatedMotion>& candidates,
             const PassingOrders& orders);
  // Admits a step that was stopped on its path, with the orders that it has.
  void readmit(const Step& step);
  // Takes back the admission of a job that is not dispatched: the job waits again, or ends.
  void withdraw(const Step& step, const AfterStop& after);
  // Starts or continues the admitted motion.
  void dispatch(const Step& step, const Moving& data, double off_path, Duration authority);
  void grant(const Step& step, Duration authority);
  void measure(const Step& step, const MotionReport& report);
  // Brakes the job's arms; at rest the job is held, canceled or failed (`after`). If the job is not
  // dispatched yet, withdraws it. A later stop does not undo a cancel or a failure.
  void brake(const Step& step, AfterStop after);
  // Handles a report that the motion has stopped, finished or faulted.
  void come_to_rest(const Step& step, const MotionReport& report);
  // Stops the arms and brakes their jobs. Jobs that are not dispatched keep their place in the
  // queue.
  void stop_arms(const Stop& stop);

  // ---- Paths and places of waiting jobs

  // Gives a waiting job a new path from its arm's position and makes it Queued again.
  void set_out_anew(const Step& step, TrajectoryPtr way);
  // Replaces a queued job's path by one from the same position.
  void go_by(const Step& step, TrajectoryPtr way);
  // Stores a plan for the job's goal with this index.
  void take_plan(const Step& step, std::size_t which, const TrajectoryPtr& way);
  void set_planned(const Step& step, bool is_planned);
  // Gives the job this alternative, at position `place` of that arm's queue.
  void take_alternative(const Step& step, std::size_t which, std::size_t place);
  // Restores the path with the number `motion`, and the sequence as it was then (`lanes`).
  void restore(const Step& step, std::uint64_t motion, Lanes lanes);
  void put_in_order(const std::vector<JobId>& jobs);
  // Changes the terms, the priority also in the orders.
  void amend(const Step& step, const AmendedTerms& terms);
  // The job does not begin while `other` waits; nullopt ends this.
  void let_pass(const Step& step, std::optional<JobId> other);

 private:
  void enter(const Step& step, StepPhase phase);
  void leave_graph(const Step& step);
  void release(const Step& step) { effect(Release{step.id}); }
  void end_as(const Step& step, const AfterStop& after, const char* canceled);
  void end_at_rest(const Step& step, const AfterStop& after);
  void refuse_approach(const Step& step, Reason reason, const std::string& why);
};

}  // namespace armloom
