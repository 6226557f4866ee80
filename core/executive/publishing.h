#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/executive/arm_reports.h"
#include "core/executive/executive.h"
#include "core/executive/queue_lists.h"
#include "core/executive/shown.h"
#include "core/executive/status_board.h"

namespace armloom {

// Publishes changes as events, and the present status on a board that other threads read
// (status_board.h). The board is updated before an event is published.
class Publisher {
 public:
  Publisher(const Shown& shown, Observer& observer);

  using Body = decltype(Event::body);
  void tell(Body body, TimePoint now);
  // Publish the scene. The board is updated at once; events of large scenes are less frequent, and
  // one event may cover several changes. Changes of holdings and allowed touch, and expired
  // objects, are published at once, because the audit of a recording relies on their times.
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
  [[nodiscard]] bool is_behind() const { return queue_pace_.is_behind || scene_pace_.is_behind; }
  void tell_tick(TimePoint now);
  void tell_state(const std::vector<Proximity>& near, TimePoint now);

  // Call after each step of the scheduler: updates the board, also with changes that have no event.
  void publish_step(TimePoint now);
  void show(JobView view, TimePoint now);  // on the board only, without an event
  void forget(JobId job, const std::string& key);
  [[nodiscard]] std::shared_ptr<const StatusBoard> board() const { return board_; }

  // Returns the view of a job. A job of an earlier session keeps its time of submission.
  [[nodiscard]] JobView view(JobId job) const;
  [[nodiscard]] const ArmReports& arms() const { return arms_; }

 private:
  void note(JobView view);
  void publish(TimePoint now);
  void publish_scene();
  void publish_signals();
  [[nodiscard]] SceneView scene() const;
  [[nodiscard]] const QueueView& queue();
  void tell_stopped(TimePoint now);
  void tell_queue(QueueView queue, TimePoint now);

  // The time of the next report of something large that changes often: it grows with the size.
  struct Pace {
    bool is_behind = false;
    TimePoint next{};
  };
  // The last reports to observers.
  struct Told {
    bool rest = false;
    std::vector<ArmId> stops = {};
    QueueView queue = {};
    std::uint64_t scene = 0;  // version
  };

  Shown shown_;
  Observer& observer_;
  std::uint64_t seq_ = 0;
  std::shared_ptr<StatusBoard> board_ = std::make_shared<StatusBoard>();
  JobLedger jobs_;
  std::vector<StatusBoard::KeyOfJob> gone_;  // forgotten since the board was published
  QueueLists lists_;
  std::set<JobId> explained_;  // jobs whose wait texts may change without a change of the job
  ArmReports arms_;
  Told told_;
  Pace queue_pace_, scene_pace_;
};

}  // namespace armloom
