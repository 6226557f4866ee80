#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/collision/state/clearance_query.h"
#include "core/executive/executive.h"
#include "core/executive/motions.h"
#include "core/executive/views.h"
#include "core/monitor/monitor.h"
#include "core/scheduler/scheduler.h"
#include "core/scheduler/trial.h"

namespace armloom {

// Every joint of the motion that does not begin (within the tolerance) where `rest` has it;
// pointers below the trajectory.
void find_start_elsewhere(const Cell& cell, const Trajectory& trajectory, const Configuration& rest,
                          Problems& problems);

class Executive::Impl final : public JobNames {
 public:
  // What create() has found good, or made: arms stand at home.
  struct Checked {
    CellPtr cell;
    PlanningScenePtr scene;
    std::shared_ptr<const Policy> policy;
    std::vector<std::unique_ptr<FaultyArm>> arms;
  };
  Impl(Checked checked, ExecutiveOptions options, JudgementService& judges, Observer& observer);

  // submission.cc
  Result<JobView> submit(JobRequest request);
  Result<std::vector<Result<JobView>>> submit_batch(std::vector<JobRequest> requests, bool atomic);
  Result<JobView> cancel(const std::string& key);
  std::vector<Result<JobView>> restore(std::vector<RestoredJob> jobs);

  // checking.cc
  void check(JobRequest request, std::function<void(Result<CheckView>)> done);

  // planning.cc
  void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<PlanOutcome>)> done);

  // drawing.cc
  void diagram(const std::string& key_a, const std::string& key_b,
               std::function<void(Result<DiagramView>)> done);

  // scene_and_faults.cc
  Result<void> change_objects(std::vector<CollisionObject> objects);
  Result<void> add_object(CollisionObject object);
  Result<void> replace_object(CollisionObject object);
  Result<void> remove_object(const std::string& name);
  Result<std::uint64_t> inject(const FaultRequest& fault);
  Result<void> remove_fault(std::uint64_t id);

  // executive.cc
  void step(const Input& input);
  [[nodiscard]] std::vector<Effect> decided(const Input& input);
  void tick(TimePoint now);

  // publishing.cc
  std::optional<JobView> job(const std::string& key) const;
  Snapshot snapshot(std::size_t ended_max) const;
  std::vector<ArmView> arms() const;

  // Empty for a job that has been forgotten since.
  std::string key(JobId job) const override;
  std::string name(JobId job) const override;
  bool has_job(ArmId arm) const override;
  bool is_stopped(ArmId arm) const override;

  void tell(std::variant<JobView, ArmView, QueueView, SceneView, MonitorEvent, Alert> body);
  std::string names_of(const std::vector<ArmId>& arms) const;  // "left, right"

  std::vector<ArmId> all_arms() const;
  bool any_moving() const;
  TimePoint settled_until() const {
    return quiet_ && motions_.all_settled() ? wake_at_.value_or(TimePoint::max()) : now_;
  }

  CellPtr cell_;
  ExecutiveOptions options_;
  Scheduler scheduler_;
  PlanningScenePtr scene_;
  std::uint64_t scene_version_ = 1;
  RunFigures figures_;
  std::size_t active_ = 0;  // jobs that have not ended
  TimePoint now_{};
  std::function<void()> wound_down_;  // set: the last act has begun
  bool keeps_waiting_ = false;        // in it

 private:
  struct Label {
    std::string key;
    std::string name;
    std::optional<TimePoint> submitted_at = {};  // in a former run
  };
  // Of a job that has been dispatched, where starts are put down.
  struct Start {
    bool is_written = false;
    std::optional<Duration> withheld = {};  // authority, until then
  };

  // What a request has become once everything about it has been checked.
  struct Prepared {
    std::string key;  // empty: one is to be given
    std::string name;
    std::vector<TrajectoryPtr> alternatives;  // the job's trajectory first; the only one, mostly
    std::optional<MotionGoal> goal;           // the trajectory is an estimate
    JobOrder order;
    int priority;
    Duration backlog_timeout;
    std::vector<std::string> after;
    std::vector<TrajectoryPtr> returns;  // of its arms, to where their clients left them
  };
  // Where joints will stand, and which keys are taken, when the jobs before it are accepted.
  struct Ahead {
    Configuration rest;
    std::vector<std::string> keys;
    std::map<ArmId, TrajectoryPtr> ways_back;  // of arms that were sent aside
    std::vector<ArmId> open = {};              // whose end of `rest` is not known yet
    bool begins_anywhere = false;              // jobs need not begin at `rest`
  };
  Result<Prepared> prepare(JobRequest request, Ahead& ahead) const;
  [[nodiscard]] std::vector<TrajectoryPtr> read_motions(const JobRequest& request, Ahead& ahead,
                                                        std::vector<TrajectoryPtr>& returns,
                                                        Problems& problems) const;
  [[nodiscard]] std::optional<MotionGoal> read_goal(const JobRequest& request,
                                                    Problems& problems) const;
  [[nodiscard]] TrajectoryPtr estimate_for(const MotionGoal& goal, Ahead& ahead) const;
  void begin_where_open(const Trajectory& motion, Ahead& ahead) const;
  void find_bad_after(const JobRequest& request, const Ahead& ahead, Problems& problems) const;
  JobView accept(Prepared prepared);
  void walk(std::shared_ptr<Trial> trial, std::function<void(Result<CheckView>)> done);
  void enter(Submit submitted, Label label);
  [[nodiscard]] JobId next_job() const;
  [[nodiscard]] Submit submission(Prepared prepared) const;
  [[nodiscard]] Submit return_of(TrajectoryPtr back, int priority) const;
  void remember_way_back(ArmId arm, const Trajectory& way);
  void label(JobId id, Label label);
  [[nodiscard]] Ahead ahead_now() const;
  std::vector<TrajectoryPtr> returns_for(const Trajectory& motion, Ahead& ahead) const;
  std::string own_key();
  Result<const Job*> known(const std::string& key, const std::string& pointer) const;
  DiagramView::Side side_of(const Job& job) const;
  DiagramView shown(DiagramView view, const Diagram& diagram) const;
  std::string free_key(JobId id) const;

  void carry_out(const Effect& effect);
  void ask_plan(const PlanMotion& asked);
  void dispatch(Dispatch dispatch);
  void grant(const Grant& grant);
  void start_is_written(JobId job);
  [[nodiscard]] bool is_withheld(JobId job) const;
  [[nodiscard]] JobView view(const Job& job) const;
  void note_aside(const YieldMove& aside);
  void watch();
  void tell_tick();
  static ClearanceQuery monitored(const PlanningScenePtr& scene);
  void tell_job(JobId job);
  void tell_arms();
  void tell_stops();
  void tell_queue();
  void count(const JobView& ended);
  [[nodiscard]] bool is_told_of_a_start(ArmId arm) const;
  ArmState state_of(ArmId arm) const;
  ArmView view_of_arm(ArmId arm) const;
  QueueView queue() const;

  JudgementService& judges_;
  Observer& observer_;
  std::vector<FaultyArm*> faulty_;  // ArmId; owned by motions_
  Motions motions_;
  Monitor monitor_;
  ClearanceQuery clearance_query_;  // with the monitor's limits
  Duration monitor_period_;
  TimePoint monitor_due_{};
  Configuration watched_;  // the configuration that the monitor looked at last
  std::vector<Proximity> clearance_;
  std::optional<TimePoint> wake_at_;
  bool quiet_ = false;             // the last cycle found all arms settled, and nothing to report
  std::optional<Question> asked_;  // and not answered
  std::map<JobId, std::shared_ptr<std::atomic<bool>>> plans_;  // open ones; set: given up

  std::unordered_map<std::string, JobId> ids_;
  std::unordered_map<JobId, Label> labels_;
  std::deque<JobId> ended_;  // oldest first
  std::unordered_map<JobId, Start> starts_;
  std::uint64_t next_fault_ = 1;
  std::uint64_t next_aside_ = 1;
  std::map<ArmId, TrajectoryPtr> ways_back_;
  std::uint64_t seq_ = 0;
  bool told_rest_ = false;
  std::vector<ArmState> told_arms_;
  std::vector<std::string> told_arm_jobs_;
  std::vector<ArmId> told_stops_;
  QueueView told_queue_;

  struct Drawn {
    TrajectoryPtr a, b;
    Configuration rest;
    std::uint64_t scene_version;
    Diagram diagram;
  };
  std::deque<Drawn> drawn_;  // the last ones, newest first
};

}  // namespace armloom
