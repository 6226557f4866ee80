#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "core/executive/authority_gate.h"
#include "core/executive/executive.h"
#include "core/executive/job_register.h"
#include "core/executive/live_scene.h"
#include "core/executive/motions.h"
#include "core/executive/queue_lists.h"
#include "core/executive/start_gate.h"
#include "core/executive/status_board.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// Tells clients what changes, and publishes what they see when they ask: on a board that other
// threads read. The board holds what an event says before the event is told.
class Publisher {
 public:
  // Whatever is shown; it outlives the publisher.
  struct Shown {
    const Cell& cell;
    const Scheduler& scheduler;
    const Motions& motions;
    const AuthorityGate& gate;
    const JobRegister& jobs;
    const StartGate& starts;
    const LiveScene& scene;
  };
  Publisher(const Shown& shown, Observer& observer);

  using Body =
      std::variant<JobView, ArmView, QueueView, SceneView, MonitorEvent, GuardEvent, Alert>;
  void tell(Body body, TimePoint now);
  // The scene has changed.
  void tell_scene(TimePoint now);
  // With an alert where it failed.
  void tell_job(JobView view, TimePoint now);
  // What is otherwise than it was when told last:
  void tell_arms(TimePoint now);
  void tell_stops();
  void tell_judged(std::uint64_t evaluations) { observer_.on_judged(evaluations); }
  // The longer the queue, the more seldom: a list of thousands is not made for each change of it.
  // That all arms are stopped, or no more, is told at once.
  void queue_may_have_changed(TimePoint now);
  void tell_queue(TimePoint now);  // what is left to be told of it, when it is time
  [[nodiscard]] bool is_behind() const { return queue_is_old_; }
  // Each control cycle.
  void tell_tick(TimePoint now);
  // Each period of the monitor.
  void tell_state(const std::vector<Proximity>& near, TimePoint now);

  // After each step of the scheduler: publishes what changed without an event, too.
  void publish_step(TimePoint now);
  // What readers see of a job, though no event tells it.
  void show(JobView view, TimePoint now);
  // The job is not known any more: `key` was its key.
  void forget(JobId job, const std::string& key);
  [[nodiscard]] std::shared_ptr<const StatusBoard> board() const { return board_; }

  // Times of a former run are shown as they were.
  [[nodiscard]] JobView view(JobId job) const;
  [[nodiscard]] std::vector<ArmView> arms() const;

 private:
  void note(JobView view);
  void look_at_arms();
  void publish(TimePoint now);
  void publish_scene();
  [[nodiscard]] const QueueView& queue();
  void tell_stopped(TimePoint now);
  void tell_queue(QueueView queue, TimePoint now);
  [[nodiscard]] bool all_stopped() const;
  [[nodiscard]] bool is_told_of_a_start(ArmId arm) const;
  [[nodiscard]] ArmState state_of(ArmId arm) const;
  [[nodiscard]] ArmStatus status_of(ArmId arm) const;
  [[nodiscard]] ArmView view_of_arm(ArmId arm, const ArmStatus& status) const;
  [[nodiscard]] std::vector<ArmAuthority> authorities() const;

  Shown shown_;
  Observer& observer_;
  std::uint64_t seq_ = 0;
  bool told_rest_ = false;
  std::shared_ptr<StatusBoard> board_ = std::make_shared<StatusBoard>();
  JobLedger jobs_;
  std::vector<StatusBoard::KeyOfJob> gone_;  // forgotten since the board was published
  QueueLists lists_;
  std::set<JobId> explained_;         // past the queue, and waiting: what they wait for may get
                                      // other words though the job does not change
  std::vector<ArmStatus> arms_;       // ArmId; as published
  std::vector<ArmStatus> told_arms_;  // ArmId
  std::vector<ArmId> told_stops_;
  QueueView told_queue_;
  bool queue_is_old_ = false;
  TimePoint next_queue_{};
  static constexpr std::size_t kShortQueue = 100;                          // jobs
  static constexpr Duration kForEachJob = std::chrono::microseconds(100);  // between two lists
};

}  // namespace armloom
