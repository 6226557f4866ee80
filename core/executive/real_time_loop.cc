#include "core/executive/real_time_loop.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "core/executive/own_checker.h"
#include "core/executive/scene_edits.h"
#include "core/executive/status_board.h"
#include "core/executive/worker.h"

namespace armloom {
namespace {

using Wall = std::chrono::steady_clock;

// A loop that is farther behind than this (machine suspended, speed too high for it) lets cell time
// slip instead of running a burst of cycles.
constexpr Wall::duration kCatchUpMax = std::chrono::milliseconds(50);

// Limits of open diagrams, plans and checks of clients.
constexpr int kDrawingsMax = 16;
constexpr int kDraftsMax = 16;
constexpr int kConsideredMax = 256;

// Inputs are handled for at least this long in a cycle, and at most until the next cycle is due.
// The rest waits for the next cycle.
constexpr Wall::duration kInputsAtLeast = std::chrono::microseconds(500);
// A cycle that is this late is reported, but at most once in kTellsAgain.
constexpr Wall::duration kTellsLate = std::chrono::milliseconds(500);
constexpr Wall::duration kTellsAgain = std::chrono::minutes(1);

// An inbox. Any thread posts to it; its owner takes all items at once.
template <class Item>
class Inbox {
 public:
  void post(Item item) {
    {
      const std::scoped_lock lock(mutex_);
      items_.push_back(std::move(item));
    }
    arrived_.notify_one();
  }
  // Waits until something arrives, `until`, or a stop request; returns all that has arrived.
  std::deque<Item> take(std::stop_token stop, Wall::time_point until) {
    std::unique_lock lock(mutex_);
    arrived_.wait_until(lock, stop, until, [this] { return !items_.empty(); });
    return std::exchange(items_, {});
  }
  // Returns all that has arrived.
  std::deque<Item> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(items_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::deque<Item> items_;
};

// A worker with a checker of its own.
struct Looker {
  OwnChecker checker;
  Worker worker;  // the last: it ends first
};

}  // namespace

class RealTimeLoop::Impl final : public JudgementService {
 public:
  using Task = RealTimeLoop::Task;
  using ObjectsTo = RealTimeLoop::ObjectsTo;

  explicit Impl(double speed) : speed_(speed) {}

  ~Impl() override {
    // The workers first: they post into the loop's inbox.
    ending_.request_stop();
    for (Looker* looker :
         {&threads_.judge, &threads_.certifier, &threads_.considerer, &threads_.artist})
      looker->worker.end();
    for (Worker* worker : {&threads_.planner, &threads_.drafter}) worker->end();
    edits_.end();
    if (!loop_.joinable()) return;
    loop_.request_stop();
    loop_.join();
  }

  void run(std::unique_ptr<Executive> executive) {
    executive_ = std::move(executive);
    board_ = executive_->board();
    loop_ = std::jthread([this](std::stop_token stop) { cycle(stop); });
  }

  // The scheduler has at most one question open.
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    asked_ = judge(threads_.judge, std::move(question), std::move(scene), std::move(done));
  }
  void interrupt() override {
    if (asked_) asked_->interrupt();
  }
  std::optional<double> progress() const override {
    return asked_ ? std::optional(asked_->share()) : std::nullopt;
  }

  // On its own thread, so that the guard does not wait for checks of jobs.
  void certify(Question question, PlanningScenePtr scene,
               std::function<void(Verdict)> done) override {
    judge(threads_.certifier, std::move(question), std::move(scene), std::move(done));
  }

  // On a thread and checker for clients, so that no job waits for it and no verdict depends on it.
  bool consider(Question question, PlanningScenePtr scene,
                std::function<void(Verdict)> done) override {
    if (open_.considered >= kConsideredMax) return false;
    judge(threads_.considerer, std::move(question), std::move(scene),
          counted(open_.considered, std::move(done)));
    return true;
  }

  bool draw(Drawing drawing, PlanningScenePtr scene, std::function<void(Diagram)> done) override {
    if (open_.drawings >= kDrawingsMax) return false;
    const auto drawn = counted(open_.drawings, std::move(done));
    threads_.artist.worker.post([this, drawn, drawing = std::move(drawing),
                                 scene = std::move(scene)] {
      CheckProgress progress;
      const std::stop_callback at_end(ending_.get_token(), [&progress] { progress.interrupt(); });
      post_urgent([drawn, diagram = threads_.artist.checker.in(scene).draw(drawing, &progress)](
                      Executive&) { drawn(diagram); });
    });
    return true;
  }

  void plan(PlanTask task) override { plan(threads_.planner, std::move(task)); }

  bool draft(PlanTask task) override {
    if (open_.drafts >= kDraftsMax) return false;
    task.done = counted(open_.drafts, std::move(task.done));
    plan(threads_.drafter, std::move(task));
    return true;
  }

  bool compute(std::function<void()> work, std::function<void()> done) override {
    if (open_.considered >= kConsideredMax) return false;
    ++open_.considered;
    threads_.considerer.worker.post([this, work = std::move(work), done = std::move(done)] {
      work();
      post_urgent([this, done](Executive&) {
        --open_.considered;
        done();
      });
    });
    return true;
  }

  void edit_scene(SceneEdit edit, ObjectsTo objects_to, SceneEdits::Then then) {
    post([this,
          edit = std::make_shared<SceneEdits::Waiting>(SceneEdits::Waiting{
              std::move(edit), std::move(objects_to), std::move(then)})](Executive& executive) {
      edits_.add(std::move(*edit), executive.scene());
      return true;
    });
  }

  void post(Task command) { commands_.came.post({false, std::move(command)}); }
  void post_urgent(std::function<void(Executive&)> command) {
    commands_.came.post({true, [command = std::move(command)](Executive& executive) {
                           command(executive);
                           return true;
                         }});
  }
  const StatusBoard& board() const { return *board_; }
  double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }

 private:
  struct Command {
    bool is_urgent;
    Task run;
  };

  std::shared_ptr<CheckProgress> judge(Looker& looker, Question question, PlanningScenePtr scene,
                                       std::function<void(Verdict)> done) {
    auto progress = std::make_shared<CheckProgress>();
    looker.worker.post([this, &looker, question = std::move(question), scene = std::move(scene),
                        done = std::move(done), progress] {
      const std::stop_callback at_end(ending_.get_token(), [&] { progress->interrupt(); });
      Verdict verdict = looker.checker.in(scene).judge(question, progress.get());
      post_urgent([verdict = std::move(verdict), done](Executive&) { done(verdict); });
    });
    return progress;
  }

  void plan(Worker& worker, PlanTask task) {
    worker.post([this, task = std::move(task)] {
      const std::stop_callback at_end(ending_.get_token(), [&task] { *task.cancelled = true; });
      post_urgent([answer = answer_of(task), done = task.done](Executive&) { done(answer); });
    });
  }

  // Counts the request as open until it is answered.
  template <class Answer>
  static std::function<void(Answer)> counted(int& open, std::function<void(Answer)> done) {
    ++open;
    return [&open, done = std::move(done)](Answer answer) {
      --open;
      done(std::move(answer));
    };
  }

  void cycle(std::stop_token stop) {
    Wall::time_point due = Wall::now();
    TimePoint cell_now{};
    while (!stop.stop_requested()) {
      take_inputs(stop, due);
      const Wall::time_point wall_now = Wall::now();
      tell_late(wall_now, wall_now - due);
      if (wall_now - due > kCatchUpMax) due = wall_now;
      const auto wall_period = std::chrono::duration_cast<Wall::duration>(
          std::chrono::duration<double, std::nano>(kControlPeriod) / speed_.load());
      for (; due <= wall_now; due += wall_period) {
        executive_->tick(cell_now);
        cell_now += kControlPeriod;
      }
      edits_.add_expiry(executive_->scene(), executive_->now());
    }
  }

  // Handles inputs until the next cycle is due.
  void take_inputs(const std::stop_token& stop, Wall::time_point due) {
    const Wall::time_point until = std::max(due, Wall::now() + kInputsAtLeast);
    std::deque<Task>& waiting = commands_.waiting;
    do {
      sort_in(waiting.empty() ? commands_.came.take(stop, due) : commands_.came.take());
      if (!waiting.empty() && waiting.front()(*executive_)) waiting.pop_front();
    } while (!stop.stop_requested() && Wall::now() < (waiting.empty() ? due : until));
  }

  void sort_in(std::deque<Command> came) {
    for (Command& command : came) {
      if (command.is_urgent) {
        command.run(*executive_);
      } else {
        commands_.waiting.push_back(std::move(command.run));
      }
    }
  }

  void tell_late(Wall::time_point now, Wall::duration late) {
    if (late < kTellsLate || now < tells_late_from_) return;
    tells_late_from_ = now + kTellsAgain;
    const auto late_ms = std::chrono::duration_cast<std::chrono::milliseconds>(late).count();
    executive_->alert({Alert::Level::warning,
                       "the control loop was delayed by " + std::to_string(late_ms) +
                           " ms: the machine is too busy, or a control cycle took too long"});
  }

  std::atomic<double> speed_;
  std::stop_source ending_;
  struct Threads {
    Looker judge, certifier, considerer, artist;
    Worker planner, drafter;
  };
  Threads threads_;
  SceneEdits edits_{[this](SceneEdits::Apply apply) {
    post([apply = std::move(apply)](Executive& executive) {
      apply(executive.scene());
      return true;
    });
  }};
  struct Open {  // open requests; of the loop thread
    int considered = 0;
    int drawings = 0;
    int drafts = 0;
  };
  Open open_;
  std::shared_ptr<CheckProgress> asked_;  // of ask(); the loop thread's
  struct Commands {
    Inbox<Command> came;
    std::deque<Task> waiting;  // of them, in their order; the loop thread's
  };
  Commands commands_;
  Wall::time_point tells_late_from_{};
  std::unique_ptr<Executive> executive_;  // the loop thread's
  std::shared_ptr<const StatusBoard> board_;
  std::jthread loop_;
};

Result<std::unique_ptr<RealTimeLoop>> RealTimeLoop::start(CellPtr cell, ExecutiveOptions options,
                                                          double speed, Observer& observer) {
  auto impl = std::make_unique<Impl>(speed);
  auto executive = Executive::create(cell, std::move(options), *impl, observer);
  if (!executive) return failure(std::move(executive.error()));
  impl->run(std::move(*executive));
  return std::unique_ptr<RealTimeLoop>(new RealTimeLoop(std::move(impl)));
}

RealTimeLoop::RealTimeLoop(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RealTimeLoop::~RealTimeLoop() = default;
void RealTimeLoop::post(std::function<void(Executive&)> command) {
  impl_->post([command = std::move(command)](Executive& executive) {
    command(executive);
    return true;
  });
}
void RealTimeLoop::post_in_parts(Task task) { impl_->post(std::move(task)); }
void RealTimeLoop::post_urgent(std::function<void(Executive&)> command) {
  impl_->post_urgent(std::move(command));
}
void RealTimeLoop::edit_scene(SceneEdit edit, ObjectsTo objects_to,
                              std::function<void(const Result<SceneEdited>&)> then) {
  impl_->edit_scene(std::move(edit), std::move(objects_to), std::move(then));
}
const StatusBoard& RealTimeLoop::board() const { return impl_->board(); }
double RealTimeLoop::speed() const { return impl_->speed(); }
void RealTimeLoop::set_speed(double speed) { impl_->set_speed(speed); }

}  // namespace armloom
