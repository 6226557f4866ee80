#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/executive/authority_gate.h"
#include "core/executive/executive.h"
#include "core/executive/job_register.h"
#include "core/executive/live_scene.h"
#include "core/executive/motions.h"
#include "core/executive/queue_lists.h"
#include "core/executive/signals.h"
#include "core/executive/start_gate.h"
#include "core/executive/status_board.h"
#include "core/executive/task.h"
#include "core/scheduler/scheduler.h"

namespace armloom {

// Publishes changes as events, and the present status on a board that other threads read
// (status_board.h). The board is updated before an event is published.
class Publisher {
 public:
  // The objects whose state is published. All of them outlive the publisher.
  struct Shown {
    const Cell& cell;
    const Scheduler& scheduler;
    const Motions& motions;
    const AuthorityGate& gate;
    const JobRegister& jobs;
    const StartGate& starts;
    const LiveScene& scene;
    const Signals& signals;
    const TaskBook& tasks;
  };
  Publisher(const Shown& shown, Observer& observer);

  using Body = decltype(Event::body);
  void tell(Body body, TimePoint now);
  // Publish the scene: on the board at once. Events of large scenes are published less often, so
  // that one event may cover several changes. What arms hold and what may touch is published at
  // once, because the audit of a recording relies on its time; what has expired, too.
  void scene_has_changed(TimePoint now);
  void tell_scene(TimePoint now);
  void tell_signal(SignalId signal, TimePoint now);
  // Publishes the job, and an alert if it failed or expired.
  void tell_job(JobView view, TimePoint now);
  // Publish only what changed since the last publication:
  void tell_arms(TimePoint now);
  void tell_stops();
  void tell_judged(std::uint64_t evaluations) { observer_.on_judged(evaluations); }
  void tell_watch() { observer_.on_watch(); }
  void tell_monitor_stop(std::size_t arms) { observer_.on_monitor_stop(arms); }
  // Publishes the queue lists if they have changed. Long lists are published less often, but a
  // change of "all arms are stopped" or of the speed override always at once.
  void queue_may_have_changed(TimePoint now);
  void tell_queue(TimePoint now);
  [[nodiscard]] bool is_behind() const { return queue_is_old_ || scene_is_old_; }
  void tell_tick(TimePoint now);
  void tell_state(const std::vector<Proximity>& near, TimePoint now);

  // Call after each step of the scheduler: updates the board, also with changes that have no event.
  void publish_step(TimePoint now);
  void show(JobView view, TimePoint now);  // on the board only, without an event
  void forget(JobId job, const std::string& key);
  [[nodiscard]] std::shared_ptr<const StatusBoard> board() const { return board_; }

  // Returns the view of a job. A job of an earlier session keeps its time of submission.
  [[nodiscard]] JobView view(JobId job) const;
  [[nodiscard]] std::vector<ArmView> arms() const;

 private:
  void note(JobView view);
  void look_at_arms();
  void publish(TimePoint now);
  void publish_scene();
  void publish_signals();
  [[nodiscard]] SceneView scene() const;
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
  std::set<JobId> explained_;    // jobs whose wait texts may change without a change of the job
  std::vector<ArmStatus> arms_;  // ArmId; as published
  std::vector<ArmStatus> told_arms_;  // ArmId
  std::vector<ArmId> told_stops_;
  QueueView told_queue_;
  bool queue_is_old_ = false;
  TimePoint next_queue_{};
  bool scene_is_old_ = false;
  TimePoint next_scene_{};
  std::uint64_t told_scene_ = 0;                                              // version
  static constexpr std::size_t kSmallScene = 100;                             // objects
  static constexpr Duration kForEachObject = std::chrono::microseconds(100);  // between two events
  static constexpr std::size_t kShortQueue = 100;                             // jobs
  static constexpr Duration kForEachJob = std::chrono::microseconds(100);     // between two lists
};

}  // namespace armloom
