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

// Where judgements are computed. Called on the strand; `done` must be called exactly once, on the
// strand again, with the answer.
class JudgementService {
 public:
  virtual ~JudgementService() = default;
  virtual void ask(Question question, PlanningScenePtr scene,
                   std::function<void(Verdict)> done) = 0;
  // The open question of ask() has become void: its answer may be one that is interrupted.
  virtual void interrupt() {}
  // How far it is, 0 to 1; nullopt: not known.
  [[nodiscard]] virtual std::optional<double> progress() const { return std::nullopt; }
  // For people who ask what would be: changes no verdict of ask() and delays none. False: too many
  // are being considered, and `done` is not called.
  [[nodiscard]] virtual bool consider(Question question, PlanningScenePtr scene,
                                      std::function<void(Verdict)> done) {
    ask(std::move(question), std::move(scene), std::move(done));
    return true;
  }
  // For certificates that the guard misses: changes no verdict of ask() either. At most one is
  // open.
  virtual void certify(Question question, PlanningScenePtr scene,
                       std::function<void(Verdict)> done) {
    ask(std::move(question), std::move(scene), std::move(done));
  }
  // For people who look, in the same way.
  [[nodiscard]] virtual bool draw(Drawing drawing, PlanningScenePtr scene,
                                  std::function<void(Diagram)> done) = 0;
  // For jobs.
  virtual void plan(PlanTask task) = 0;
  // For people who ask, in the same way as draw().
  [[nodiscard]] virtual bool draft(PlanTask task) = 0;
};

class Policy;

// Where everything that happens is told. Called on the strand; must not block.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void on_event(const Event& event) = 0;
  // Every control tick: measured positions of the whole cell. Cheap consumers only.
  virtual void on_tick(TimePoint now, const Configuration& measured) = 0;
  // Told before on_tick() when it has changed: from this tick on no arm moves, or one does. At the
  // beginning arms count as moving.
  virtual void on_rest(bool /*at_rest*/) {}
  // Other arms than before are stopped until they are resumed; that all are as the run winds down
  // is none of this. None are at the beginning.
  virtual void on_stops(const std::vector<ArmId>& /*stopped*/) {}
  // A question of the scheduler is answered, which took so many collision evaluations.
  virtual void on_judged(std::uint64_t /*evaluations*/) {}
  // Every monitor period.
  virtual void on_state(const StateFrame& frame) = 0;
};

// Where it is put down that a job is about to move, before it does: whoever starts again after a
// crash has none of them done twice. Called on the strand; must not block.
class StartLog {
 public:
  virtual ~StartLog() = default;
  // Of each job of a client once, before its first motion. Until `written` is called, on the
  // strand, the job's arms have no authority to leave where they stand.
  virtual void about_to_move(JobId job, std::function<void()> written) = 0;
};

// Where everything is put down that comes to an executive from outside and changes something
// (executive_input.h), before it does. `ticks`: so many control cycles had begun. Called on the
// strand; must not block.
struct ExecutiveInput;
class InputLog {
 public:
  virtual ~InputLog() = default;
  virtual void came(std::uint64_t ticks, const ExecutiveInput& input) = 0;
};

// A job of a former run, with the id that it had.
struct RestoredJob {
  JobId id;
  JobRequest request;
  TimePoint submitted_at;  // before this run began: less than zero
};

struct ExecutiveOptions {
  std::string policy;                             // empty: the cell's
  std::shared_ptr<const Policy> own_policy = {};  // instead of one that has a name
  std::uint64_t seed = 1;                         // of the simulated arms' noise
  std::size_t ended_kept = 1000;                  // ended jobs that stay readable
  std::size_t waiting_max = 10'000;               // jobs that may be active at once
  // What the trajectories of active jobs may hold together; a job beyond it is refused.
  std::size_t active_bytes_max = std::size_t{256} << 20;
  // And those of ended jobs: those that ended longest ago are forgotten first, but never the last.
  std::size_t ended_bytes_max = std::size_t{32} << 20;
  JobId first_job{1};          // of those that clients submit; former runs had the ones before
  StartLog* starts = nullptr;  // outlives the executive; null: nobody asks
  InputLog* inputs = nullptr;  // likewise
  // For tests: from then on only the arms' controllers go on, as if the executive's thread had
  // ended.
  std::optional<TimePoint> dies_at = {};
};

// The figures of a whole run.
struct RunFigures {
  TimePoint last_end{};
  std::vector<Duration> busy;  // per arm: time in motion
  Duration together{};         // time in which at least two arms were in motion
  // Smallest that the monitor saw between arms, and of arms from what stands still
  // (ClearanceQuery::closest_apart); +inf: never near.
  double min_clearance_m;
  double between_arms_m;  // the smallest of two arms alone; +inf: never near
  std::uint64_t monitor_stops = 0;
  std::uint64_t guard_refusals = 0;  // that the scheduler did not expect (GuardEvent)
};

// The coordination diagram of two jobs: a layer for each arm of A and each other arm of B, whose
// cells cover the rectangle of both durations. Times of cells and sides are trajectory time.
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
    std::optional<DiagramContact> met;  // from where both are
  };
  TimePoint time;  // when it was asked for
  Side a;
  Side b;
  std::vector<Layer> layers;
  std::uint64_t evaluations = 0;
  std::uint64_t scene_version = 0;
};

// The one strand where clock, scheduler, checks, monitor and arms meet. Not thread-safe: every
// call comes from the strand's thread (the simulation's loop, or RealTimeLoop's thread). Owns no
// thread and no clock: its drivers call tick() with growing cell time.
class Executive {
 public:
  // Problems: homes in conflict, unknown policy, controller type unknown.
  [[nodiscard]] static Result<std::unique_ptr<Executive>> create(CellPtr cell,
                                                                 ExecutiveOptions options,
                                                                 JudgementService& judges,
                                                                 Observer& observer);
  ~Executive();

  // Validates and hands the job to the scheduler at time `now()`. Problems: everything validate()
  // finds (pointers begin with "/trajectory"), a key in use (conflict), the queue full
  // (unavailable), a start away from where the arm will be, an `after` that is not known, has
  // failed, or is the job itself. A motion in which the arm hits itself is found later (the job
  // fails with Reason::self_collision), so is whether there is a way to a goal (no_plan).
  [[nodiscard]] Result<JobView> submit(JobRequest request);
  // Several at once, in order; a job may come `after` an earlier one of the batch. Atomic: all are
  // accepted or none; problems point to "/jobs/<index>/...". Else each has its own answer. Part by
  // part (batch.h), so that a large one holds up no control cycle; nothing else may be submitted
  // before the answers are there. The executive outlives it.
  class Batch;
  using BatchAnswers = Result<std::vector<Result<JobView>>>;
  [[nodiscard]] std::shared_ptr<Batch> open_batch(std::vector<JobRequest> requests, bool atomic);
  // Jobs that had not begun when a former run ended, in the order of their ids, before any job of
  // this one; each has its answer. Unlike a client's they may begin elsewhere than where their arms
  // will stand: such a one fails at its turn. Problems: as submit() has them.
  [[nodiscard]] std::vector<Result<JobView>> restore(std::vector<RestoredJob> jobs);
  // Judges the job as if it were to start now, beside everything that holds a reservation, and
  // changes nothing. `done` is called on the strand, at once or when the verdict is there.
  void check(JobRequest request, std::function<void(Result<CheckView>)> done);
  // How an arm would get there, of several the one that would arrive first as a job: a trajectory,
  // not executed, with what check() says of it; beside all other arms where they will be when all
  // accepted jobs have run. `done` as of check(). An inquiry whose `cancelled` is set is answered
  // soon. Problems: names, sizes, limits (pointers "/arm", "/to/...", "/start/..."); unavailable:
  // too many are being planned.
  void plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
            std::function<void(Result<PlanOutcome>)> done);
  // What the motions of two jobs do to each other, ended jobs included while they are known. `done`
  // is called on the strand, at once or when it is drawn. Problems: not_found; invalid: no two
  // different arms are in it; unavailable: too many are being drawn. Pointers: "?with" for B.
  void diagram(const std::string& key_a, const std::string& key_b,
               std::function<void(Result<DiagramView>)> done);
  // Now, or at `at` by the control cycle itself, unless this is called again before with another
  // instant (hold_to_run.h). Problems: not_found; conflict when it has ended.
  [[nodiscard]] Result<JobView> cancel(const std::string& key, std::optional<TimePoint> at = {});
  // Nobody was told that it was accepted, and nobody will be: it ends as a cancelled one does, and
  // is not known any more then; its key is free.
  void withdraw(const std::string& key);
  // Counts at once (scheduler/amending.h). Problems: those of cancel().
  [[nodiscard]] Result<JobView> amend(const std::string& key, JobAmendment amendment);
  // Another way for the job, from where its arm stands to where its own way ends, given what else
  // is there (scheduler/ways/replanning.h). One in motion is brought to rest first. Problems:
  // not_found; conflict when it has ended, or is such that it can be given no other way.
  [[nodiscard]] Result<JobView> replan(const std::string& key);

  // Told to everybody; changes nothing.
  void alert(Alert alert);
  void stop(const std::vector<ArmId>& arms, const std::string& cause);
  void resume(const std::vector<ArmId>& arms);
  // Which one decides, and may be another (active_policy.h).
  class ActivePolicy;
  [[nodiscard]] ActivePolicy policy();

  // The last act: stops all arms, of which nobody is alarmed, and when they are at rest every job
  // that has not ended becomes `interrupted`, or every one that has begun where others are kept for
  // the next run; then `done` is called, on the strand. Accepts no job from now on.
  enum class Waiting { ends, is_kept };
  void wind_down(const std::string& cause, Waiting waiting, std::function<void()> done);

  // The planning scene, and its objects, which may be changed.
  [[nodiscard]] LiveScene& scene();

  // What is wrong with the simulated arms, as clients want it.
  [[nodiscard]] ArmFaults& faults();

  [[nodiscard]] std::optional<JobView> job(const std::string& key) const;
  // The motion of a job while it is known; of a goal that is not planned yet, and of alternatives,
  // the likeliest. Null: no such job.
  [[nodiscard]] TrajectoryPtr trajectory(const std::string& key) const;
  // What clients see, for every thread (status_board.h).
  [[nodiscard]] std::shared_ptr<const StatusBoard> board() const;
  // As the board has it. With the `ended_max` jobs that ended last, at most.
  [[nodiscard]] Snapshot snapshot(std::size_t ended_max = ~std::size_t{0}) const;
  [[nodiscard]] std::vector<ArmView> arms() const;
  // When each arm is expected to do what is admitted (timeline.h).
  [[nodiscard]] TimelineView timeline() const;
  [[nodiscard]] TimePoint now() const;
  [[nodiscard]] bool all_ended() const;  // no job is active
  // Before this instant time alone changes nothing: every arm stands until it gets a command, and
  // no timeout or planned start is to come sooner (TimePoint::max(): none at all); not later than
  // now(): something goes on. What may change something sooner: an input, a judgement that is open.
  [[nodiscard]] TimePoint settled_until() const;
  [[nodiscard]] const RunFigures& figures() const;

  // One control cycle. `now` must grow by kControlPeriod from call to call, or by a multiple of it
  // up to settled_until().
  void tick(TimePoint now);

 private:
  class Impl;
  explicit Executive(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// A batch in one go.
[[nodiscard]] Executive::BatchAnswers submit_batch(Executive& executive,
                                                   std::vector<JobRequest> requests, bool atomic);
// Every arm of the cell.
void stop_all(Executive& executive, const std::string& cause);
void resume_all(Executive& executive);

}  // namespace armloom
