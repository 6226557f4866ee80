#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/arm/faulty_arm.h"
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
#include "core/model/cell.h"

namespace armloom {

class StatusBoard;
struct TimelineView;

// Computes verdicts, plans and diagrams. Called on the strand; must call `done` exactly once, on
// the strand.
class JudgementService {
 public:
  virtual ~JudgementService() = default;
  virtual void ask(Question question, PlanningScenePtr scene,
                   std::function<void(Verdict)> done) = 0;
  // The open question of ask() is void: its answer may be an interrupted verdict.
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
};

class Policy;

// Receives everything that happens. Called on the strand; must not block.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_event(const Event& event) = 0;
  // Called in every control cycle; must be fast.
  virtual void on_tick(TimePoint now, const Configuration& measured) = 0;
  // Called before on_tick() when no arm moves any more, or one does again. Initially arms are
  // assumed to move.
  virtual void on_rest(bool /*at_rest*/) {}
  // Called when the set of stopped arms changes (initially none), but not for the final stop.
  virtual void on_stops(const std::vector<ArmId>& /*stopped*/) {}
  // Called for each answered question of the scheduler.
  virtual void on_judged(std::uint64_t /*evaluations*/) {}
  // Called in every monitor period.
  virtual void on_state(const StateFrame& frame) = 0;
};

// Records that a job is about to move, so that after a crash no job runs twice. Called on the
// strand; must not block.
class StartLog {
 public:
  virtual ~StartLog() = default;
  // Called once per client job, before its first motion. Its arms may not move until `written` is
  // called, on the strand.
  virtual void about_to_move(JobId job, std::function<void()> written) = 0;
};

// Records every external input (executive_input.h) before it takes effect. `ticks`: control cycles
// begun. Called on the strand; must not block.
struct ExecutiveInput;
class InputLog {
 public:
  virtual ~InputLog() = default;
  virtual void came(std::uint64_t ticks, const ExecutiveInput& input) = 0;
};

struct RestoredJob {
  JobId id;
  JobRequest request;
  TimePoint submitted_at;  // before this session: negative
};

struct ExecutiveOptions {
  std::string policy;                             // the cell's if empty
  std::shared_ptr<const Policy> own_policy = {};  // overrides `policy`
  std::uint64_t seed = 1;                         // for the noise of the simulated arms
  std::size_t ended_kept = 1000;
  std::size_t waiting_max = 10'000;  // active jobs
  // Memory for trajectories of active jobs; beyond it jobs are refused.
  std::size_t active_bytes_max = std::size_t{256} << 20;
  // Memory for trajectories of ended jobs; the oldest are forgotten first, but never the last.
  std::size_t ended_bytes_max = std::size_t{32} << 20;
  JobId first_job{1};          // the first client job of this session
  StartLog* starts = nullptr;  // outlives the executive; may be null
  InputLog* inputs = nullptr;  // likewise
  // For tests: from then on only the controllers run, as after the death of the executive.
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

// A coordination diagram with a layer for each arm of A and each other arm of B, whose cells cover
// the rectangle of both durations. Times of cells and sides are trajectory time.
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
    std::optional<DiagramContact> met;  // first contact if both go on from their progress
  };
  TimePoint time;  // time of the request
  Side a;
  Side b;
  std::vector<Layer> layers;
  std::uint64_t evaluations = 0;
  std::uint64_t scene_version = 0;
};

// Runs clock, scheduler, checks, monitor and arms on one strand. Not thread-safe; owns no thread
// and no clock: a driver (simulation, RealTimeLoop) calls tick() with growing cell time.
class Executive {
 public:
  // Problems: arms in conflict at home, unknown policy, unknown controller type.
  [[nodiscard]] static Result<std::unique_ptr<Executive>> create(CellPtr cell,
                                                                 ExecutiveOptions options,
                                                                 JudgementService& judges,
                                                                 Observer& observer);
  ~Executive();

  // Validates the job and submits it at now(). Problems: those of validate() (pointers begin with
  // "/trajectory"); a key in use (conflict); the queue is full (unavailable); a start away from
  // where the arm will be; an `after` that is unknown, has failed, or is the job itself.
  // Self-collisions (Reason::self_collision) and goals without a path (no_plan) are found later.
  [[nodiscard]] Result<JobView> submit(JobRequest request);
  // Opens a batch, to be submitted in chunks (batch.h) that delay no control cycle. A job may name
  // earlier ones in `after`. Atomic: all jobs or none; problems point to "/jobs/<index>/...".
  // Otherwise each job has its own answer. Submit nothing else before the answers. The executive
  // outlives the batch.
  class Batch;
  using BatchAnswers = Result<std::vector<Result<JobView>>>;
  [[nodiscard]] std::shared_ptr<Batch> open_batch(std::vector<JobRequest> requests, bool atomic);
  // Restores waiting jobs of an earlier session, in order of their ids, before any new job. A wrong
  // start is no problem here, but fails the job at its turn. Problems: those of submit().
  [[nodiscard]] std::vector<Result<JobView>> restore(std::vector<RestoredJob> jobs);
  // Checks the job as if it started now and changes nothing. `done` is called on the strand, at
  // once or later.
  void check(JobRequest request, std::function<void(Result<CheckView>)> done);
  // Plans a trajectory without executing it, around all other arms where they will be after all
  // accepted jobs; of several arms the first to arrive. The outcome includes the result of check().
  // `done` as for check(); soon if the client sets `cancelled`. Problems: names, sizes, limits
  // (pointers "/arm", "/to/...", "/start/..."); unavailable: too many plans are open.
  void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<PlanOutcome>)> done);
  // Draws the coordination diagram of two jobs, active or ended. `done` as for check(). Problems:
  // not_found; invalid: they do not have two different arms; unavailable: too many drawings are
  // open. Pointers: "?with" for B.
  void diagram(const std::string& key_a, const std::string& key_b,
               std::function<void(Result<DiagramView>)> done);
  // Cancels the job now, or by the control cycle at `at`, unless a later call sets another time
  // (hold_to_run.h). Problems: not_found; conflict if it has ended.
  [[nodiscard]] Result<JobView> cancel(const std::string& key, std::optional<TimePoint> at = {});
  // Rolls back a job whose acceptance was never acknowledged to the client, for example because it
  // could not be stored. It is canceled, then forgotten, and its key can be reused. Event
  // subscribers do see it created and canceled.
  void roll_back(const std::string& key);
  // Changes the job's terms at once (scheduler/amending.h). Problems: those of cancel().
  [[nodiscard]] Result<JobView> amend(const std::string& key, JobAmendment amendment);
  // Replans the job (scheduler/ways/replanning.h). A moving job is first brought to rest. Problems:
  // not_found; conflict if it has ended or cannot be replanned.
  [[nodiscard]] Result<JobView> replan(const std::string& key);

  void alert(Alert alert);
  void stop(const std::vector<ArmId>& arms, const std::string& cause);
  void resume(const std::vector<ArmId>& arms);
  class ActivePolicy;
  [[nodiscard]] ActivePolicy policy();

  // Graceful shutdown: stops all arms without an alert, then interrupts every job that has not
  // ended, or with Waiting::is_kept every job that has begun, then calls `done` on the strand.
  // Accepts no more jobs.
  enum class Waiting { ends, is_kept };
  void wind_down(const std::string& cause, Waiting waiting, std::function<void()> done);

  [[nodiscard]] LiveScene& scene();

  [[nodiscard]] ArmFaults& faults();

  [[nodiscard]] std::optional<JobView> job(const std::string& key) const;
  // Returns the job's motion, or the likeliest if not decided yet; null if the job is unknown.
  [[nodiscard]] TrajectoryPtr trajectory(const std::string& key) const;
  // The published status, for any thread (status_board.h).
  [[nodiscard]] std::shared_ptr<const StatusBoard> board() const;
  // With at most the `ended_max` jobs that ended last.
  [[nodiscard]] Snapshot snapshot(std::size_t ended_max = ~std::size_t{0}) const;
  [[nodiscard]] std::vector<ArmView> arms() const;
  [[nodiscard]] TimelineView timeline() const;
  [[nodiscard]] TimePoint now() const;
  [[nodiscard]] bool all_ended() const;
  // Returns the time before which nothing changes without an input or an answer, because every arm
  // rests and no timeout or planned start is due. TimePoint::max() if there is none; at most now()
  // if anything is in progress.
  [[nodiscard]] TimePoint settled_until() const;
  [[nodiscard]] const RunFigures& figures() const;

  // Runs one control cycle. `now` must grow by kControlPeriod per call, or by a multiple of it up
  // to settled_until().
  void tick(TimePoint now);

 private:
  class Impl;
  explicit Executive(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

[[nodiscard]] Executive::BatchAnswers submit_batch(Executive& executive,
                                                   std::vector<JobRequest> requests, bool atomic);
void stop_all(Executive& executive, const std::string& cause);
void resume_all(Executive& executive);

}  // namespace armloom
