#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/arm/make_controller.h"
#include "core/base/problem.h"
#include "core/coordination/diagram.h"
#include "core/coordination/motion.h"
#include "core/coordination/verdict.h"
#include "core/executive/arm_faults.h"
#include "core/executive/events.h"
#include "core/executive/job_request.h"
#include "core/executive/live_scene.h"
#include "core/executive/plan_ahead.h"
#include "core/executive/plan_task.h"
#include "core/executive/signals.h"
#include "core/jobs/speed_override.h"
#include "core/model/cell.h"

namespace armloom {

class StatusBoard;
struct TimelineView;

// Computes verdicts, plans and diagrams. Its functions are called on the strand, and must call
// `done` exactly once, on the strand.
class JudgementService {
 public:
  virtual ~JudgementService() = default;
  virtual void ask(Question question, PlanningScenePtr scene,
                   std::function<void(Verdict)> done) = 0;
  // The answer to the open question of ask() is no longer needed: the verdict may be an interrupted
  // verdict.
  virtual void interrupt() {}
  // Returns the progress of ask(), 0 to 1; nullopt if not known.
  [[nodiscard]] virtual std::optional<double> progress() const { return std::nullopt; }
  // Answers a what-if question without affecting ask(). Returns false, without calling `done`, if
  // too many are open.
  [[nodiscard]] virtual bool consider(Question question, PlanningScenePtr scene,
                                      std::function<void(Verdict)> done) {
    ask(std::move(question), std::move(scene), std::move(done));
    return true;
  }
  // Finds certificates that the guard misses, without affecting ask(). At most one is open.
  virtual void certify(Question question, PlanningScenePtr scene,
                       std::function<void(Verdict)> done) {
    ask(std::move(question), std::move(scene), std::move(done));
  }
  // Draws a diagram for a client. Returns false like consider().
  [[nodiscard]] virtual bool draw(Drawing drawing, PlanningScenePtr scene,
                                  std::function<void(Diagram)> done) = 0;
  // Plans for a job.
  virtual void plan(PlanTask task) = 0;
  // Plans for a client's inquiry. Returns false like consider().
  [[nodiscard]] virtual bool draft(PlanTask task) = 0;
  // Runs `work` for a client's question, on any thread. Returns false like consider().
  [[nodiscard]] virtual bool compute(std::function<void()> work, std::function<void()> done) {
    work();
    done();
    return true;
  }
};

struct Policy;

// Receives everything that happens. Called on the strand; must not block.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_event(const Event& event) = 0;
  // Called in every control cycle; must be fast.
  virtual void on_tick(TimePoint now, const Configuration& measured) = 0;
  // Called after on_tick() with the true positions of simulated arms. They differ from `measured`
  // if reports are late, lost, noisy or false. Other arms: as measured.
  virtual void on_truth(TimePoint /*now*/, const Configuration& /*positions*/) {}
  // Called before on_tick() when the last moving arm has come to rest (true), or an arm moves again
  // (false). Arms are assumed to move initially.
  virtual void on_rest(bool /*at_rest*/) {}
  // Called when the set of stopped arms changes (initially none). Not called for the stop at
  // shutdown.
  virtual void on_stops(const std::vector<ArmId>& /*stopped*/) {}
  // Called for each answered question of the scheduler.
  virtual void on_judged(std::uint64_t /*evaluations*/) {}
  // Called when a monitor period begins, and when the monitor has stopped arms in it.
  virtual void on_watch() {}
  virtual void on_monitor_stop(std::size_t /*arms*/) {}
  // Called in every monitor period.
  virtual void on_state(const StateFrame& frame) = 0;
};

// Records that a job is about to move, so that no job runs twice after a crash. Called on the
// strand; must not block.
class StartLog {
 public:
  virtual ~StartLog() = default;
  // Called once per client job, before its first motion. The job's arms do not move until the log
  // calls `written`, on the strand.
  virtual void about_to_move(JobId job, std::function<void()> written) = 0;
  // Called after a step of the job has attached or detached an object (HeldView::link is empty if
  // the object is in the scene). The job's next step waits until the log calls `written`, on the
  // strand.
  virtual void has_moved(JobId job, const HeldView& object, std::function<void()> written) = 0;
};

// Records every external input (executive_input.h) before it takes effect. `ticks`: number of
// control cycles begun so far. Called on the strand; must not block.
struct ExecutiveInput;
class InputLog {
 public:
  virtual ~InputLog() = default;
  virtual void came(std::uint64_t ticks, const ExecutiveInput& input) = 0;
};

struct RestoredJob {
  JobId id;
  JobRequest request;
  TimePoint submitted_at;  // negative, because before this session
};

struct ExecutiveOptions {
  std::string policy;                             // the cell's if empty
  std::shared_ptr<const Policy> own_policy = {};  // overrides `policy`
  std::uint64_t seed = 1;                         // for the noise of the simulated arms
  ControllerTypes controllers = {};               // simulated_controllers() if empty
  std::size_t ended_kept = 1000;
  std::size_t waiting_max = 10'000;  // active jobs
  // Largest memory for trajectories of active jobs. Jobs that would exceed it are refused.
  std::size_t active_bytes_max = std::size_t{256} << 20;
  // Largest memory for trajectories of ended jobs. The oldest jobs are forgotten first; the job
  // that ended last is always kept.
  std::size_t ended_bytes_max = std::size_t{32} << 20;
  JobId first_job{1};                // the first client job of this session
  Signals::Write write_signal = {};  // to I/O devices; without it, signals are simulated
  StartLog* starts = nullptr;        // outlives the executive; may be null
  InputLog* inputs = nullptr;        // likewise
  bool monitored = true;             // for tests: false switches the monitor off
  // For tests: from this time on only the controllers run, as if the executive had died.
  std::optional<TimePoint> dies_at = {};
};

struct RunFigures {
  TimePoint last_end{};
  std::vector<Duration> busy;  // per arm: time in motion
  Duration together{};         // time in which at least two arms were in motion
  // Smallest distances between arms, and of arms from the scene (ClearanceQuery::closest_apart);
  // +inf: never near.
  double min_clearance_m;
  double between_arms_m;  // between arms alone
  std::uint64_t monitor_stops = 0;
  std::uint64_t guard_refusals = 0;  // unexpected (GuardEvent)
};

// A coordination diagram of two jobs A and B. It has a layer for each pair of an arm of A and a
// different arm of B. The cells of a layer cover the rectangle of both durations. Times of cells
// and sides are trajectory time.
struct DiagramView {
  struct Side {
    std::string job;  // key
    JobState state = JobState::queued;
    Duration duration{};
    Duration progress{};  // at `time`
  };
  struct Layer {
    std::string arm_a;
    std::string arm_b;
    std::vector<DiagramCell> cells;
    std::optional<DiagramContact> met;  // first contact if both jobs go on from their progress
  };
  TimePoint time;  // time of the request
  Side a;
  Side b;
  std::vector<Layer> layers;
  std::uint64_t evaluations = 0;
  std::uint64_t scene_version = 0;
};

// What-if questions of clients, and views that are made on request. They change nothing. Used on
// the strand.
class Inquiries {
 public:
  virtual ~Inquiries() = default;
  // Finds what would happen to the job if it were submitted now (Trial). Changes nothing. `done` is
  // called on the strand, at once or later. Of a job with steps, checks each motion in order: from
  // where the step before it ends, with what the arms then hold, while all arms of other jobs are
  // where they are now. Ends with the first that is not free.
  virtual void check(JobRequest request, std::function<void(Result<CheckView>)> done) = 0;
  // Plans a trajectory without executing it, around all other arms where they will be after all
  // accepted jobs. Of several candidate arms, plans for the arm that arrives first. The outcome
  // includes the result of check(). `done` is called on the strand, at once or later; soon if the
  // client sets `cancelled`. Problems: wrong names or sizes, broken limits (pointers "/arm",
  // "/to/...", "/start/..."); unavailable: too many plans are open.
  virtual void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                    std::function<void(Result<PlanOutcome>)> done) = 0;
  // Plans all motions of a job with steps without executing them: each from where the step before
  // it ends, with what the arms then hold. Changes nothing. Otherwise like plan() of a motion.
  // Problems: those of submit(); unavailable: too many plans are open.
  virtual void plan(StepsInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                    std::function<void(Result<StepsPlan>)> done) = 0;
  // Draws the coordination diagram of two jobs, active or ended. `done` is called on the strand, at
  // once or later. Problems: not_found; invalid: the jobs do not have two different arms;
  // unavailable: too many drawings are open. The pointer "?with" means `key_b`.
  virtual void diagram(const std::string& key_a, const std::string& key_b,
                       std::function<void(Result<DiagramView>)> done) = 0;
  // Returns the job's motion; null if the job is unknown. If the arm is undecided, returns the
  // motion of the likeliest arm.
  [[nodiscard]] virtual TrajectoryPtr trajectory(const std::string& key) const = 0;
  [[nodiscard]] virtual TimelineView timeline() const = 0;
};

// Runs clock, scheduler, checks, monitor and arms on one strand. Not thread-safe. It owns no thread
// and no clock: a driver (Simulation, RealTimeLoop) calls tick() with growing cell time.
class Executive {
 public:
  // Problems: arms in conflict at home, unknown policy, unknown controller type.
  [[nodiscard]] static Result<std::unique_ptr<Executive>> create(CellPtr cell,
                                                                 ExecutiveOptions options,
                                                                 JudgementService& judges,
                                                                 Observer& observer);
  ~Executive();

  // Validates the job and submits it at now(). Self-collisions (Reason::self_collision) and goals
  // without a path (no_plan) are found later. Problems:
  // - those of validate() (pointers begin with "/trajectory")
  // - the key is in use (conflict)
  // - the queue is full (unavailable)
  // - the trajectory does not begin where the arm will be
  // - a job in `after` is unknown, has failed, or is the job itself
  [[nodiscard]] Result<JobView> submit(JobRequest request);
  // Opens a batch, which is submitted in chunks (batch.h) that are short enough not to delay a
  // control cycle. A job may name earlier jobs of the batch in `after`. With `atomic`, all jobs are
  // accepted or none, and problems point to "/jobs/<index>/...". Otherwise each job has its own
  // answer. Submit nothing else before the answers are there. The executive outlives the batch.
  class Batch;
  using BatchAnswers = Result<std::vector<Result<JobView>>>;
  [[nodiscard]] std::shared_ptr<Batch> open_batch(std::vector<JobRequest> requests, bool atomic);
  // Restores waiting jobs of an earlier session, in order of their ids. Call before any new job is
  // submitted. A job that begins elsewhere than its arm will be is accepted, but fails at its turn.
  // Problems: those of submit().
  [[nodiscard]] std::vector<Result<JobView>> restore(std::vector<RestoredJob> jobs);
  // Cancels the job, now or in the control cycle at `at`. A later call can set another time before
  // that (hold_to_run.h). Problems: not_found; conflict if the job has ended.
  [[nodiscard]] Result<JobView> cancel(const std::string& key, std::optional<TimePoint> at = {});
  // Rolls back a job whose acceptance was never acknowledged to the client, for example because the
  // job could not be stored. The job is canceled, then forgotten, and its key can be used again.
  // Event subscribers still see the job created and canceled.
  void roll_back(const std::string& key);
  // Changes the job's terms at once (Amend). Problems: those of cancel().
  [[nodiscard]] Result<JobView> amend(const std::string& key, JobAmendment amendment);
  // Replans the job (scheduler/ways/replanning.h). A moving job is first brought to rest. Problems:
  // not_found; conflict if the job has ended or cannot be replanned.
  [[nodiscard]] Result<JobView> replan(const std::string& key);

  void alert(Alert alert);
  // The arms stay stopped until they are resumed. Category 0 takes moving arms off their paths:
  // their jobs fail.
  void stop(const std::vector<ArmId>& arms, const std::string& cause,
            StopCategory category = StopCategory::brake);
  // Returns the arms that stay stopped, because the link to their controller is not up.
  std::vector<ArmId> resume(const std::vector<ArmId>& arms);
  // Sets the speed override of the arm, or of the cell: the largest share of the planned speed,
  // from now on, also in motion (SpeedOverride). Precondition: SpeedOverride::is_valid(share).
  void set_speed(std::optional<ArmId> arm, double share);
  class ActivePolicy;
  [[nodiscard]] ActivePolicy policy();

  // Releases an object that an arm holds. It stays at its position as a scene object. Operators use
  // this after a failed job. Returns the object. Problems:
  // - not_found; "not-held": no arm holds it
  // - "arm-moves"
  // - "job-under-way": a job with steps that has begun moves the arm
  [[nodiscard]] Result<CollisionObject> detach(const std::string& object);

  // Shuts down. Accepts no more jobs and stops all arms without an alert. When the arms are at
  // rest, interrupts every job that has not ended, or with Waiting::is_kept only every job that has
  // begun. Then calls `done` on the strand.
  enum class Waiting { ends, is_kept };
  void wind_down(const std::string& cause, Waiting waiting, std::function<void()> done);

  [[nodiscard]] Inquiries& inquiries();

  [[nodiscard]] LiveScene& scene();

  [[nodiscard]] ArmFaults& faults();

  [[nodiscard]] Signals& signals();

  [[nodiscard]] std::optional<JobView> job(const std::string& key) const;
  // The published status, for any thread (status_board.h).
  [[nodiscard]] std::shared_ptr<const StatusBoard> board() const;
  // Returns the status with all active jobs and at most the `ended_max` jobs that ended last.
  [[nodiscard]] Snapshot snapshot(std::size_t ended_max = ~std::size_t{0}) const;
  [[nodiscard]] std::vector<ArmView> arms() const;
  [[nodiscard]] TimePoint now() const;
  [[nodiscard]] bool all_ended() const;
  // Returns the time until which nothing changes without an input or an answer, because every arm
  // rests and no timeout or planned start is due before. TimePoint::max() if nothing is due at all;
  // at most now() if anything is in progress.
  [[nodiscard]] TimePoint settled_until() const;
  [[nodiscard]] const RunFigures& figures() const;

  // Runs one control cycle. From call to call, `now` must grow by kControlPeriod, or by a multiple
  // of kControlPeriod that does not pass settled_until().
  void tick(TimePoint now);

 private:
  class Impl;
  explicit Executive(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

[[nodiscard]] Executive::BatchAnswers submit_batch(Executive& executive,
                                                   std::vector<JobRequest> requests, bool atomic);
void stop_all(Executive& executive, const std::string& cause,
              StopCategory category = StopCategory::brake);
std::vector<ArmId> resume_all(Executive& executive);  // as Executive::resume()

}  // namespace armloom
