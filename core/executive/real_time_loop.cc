#include "core/executive/real_time_loop.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/collision/check/motion_checker.h"

namespace armloom {
namespace {

using Wall = std::chrono::steady_clock;

// A loop that is farther behind than this (machine suspended, speed too high for it) lets cell time
// slip instead of running a burst of cycles.
constexpr Wall::duration kCatchUpMax = std::chrono::milliseconds(50);

// So many diagrams may be asked for and not drawn yet.
constexpr int kDrawingsMax = 16;
// And so many plans and checks of clients.
constexpr int kDraftsMax = 16;
constexpr int kConsideredMax = 256;

// What comes in has at least so long in a cycle, and at most until the next one is due: what is
// left waits for the one after.
constexpr Wall::duration kInputsAtLeast = std::chrono::microseconds(500);
// A cycle that comes so much too late is told, but not more often than that.
constexpr Wall::duration kTellsLate = std::chrono::milliseconds(500);
constexpr Wall::duration kTellsAgain = std::chrono::minutes(1);

// A closed-off inbox: posted by any thread, taken whole by the one that owns it.
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
  // What has arrived.
  std::deque<Item> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(items_, {});
  }
  std::deque<Item> take(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, stop, [this] { return !items_.empty(); });
    return std::exchange(items_, {});
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::deque<Item> items_;
};

}  // namespace

class RealTimeLoop::Impl final : public JudgementService {
 public:
  using Task = RealTimeLoop::Task;

  explicit Impl(double speed) : speed_(speed) {}

  ~Impl() override {
    // The workers first: they post into the loop's inbox.
    for (std::jthread* thread : {&judge_, &considerer_, &artist_, &planner_, &drafter_, &loop_}) {
      if (!thread->joinable()) continue;
      thread->request_stop();
      thread->join();
    }
  }

  void run(std::unique_ptr<Executive> executive) {
    executive_ = std::move(executive);
    judge_ = std::jthread([this](std::stop_token stop) { judge_questions(questions_, stop); });
    considerer_ =
        std::jthread([this](std::stop_token stop) { judge_questions(considered_, stop); });
    artist_ = std::jthread([this](std::stop_token stop) { draw_diagrams(stop); });
    planner_ = std::jthread([this](std::stop_token stop) { make_plans(plans_, stop); });
    drafter_ = std::jthread([this](std::stop_token stop) { make_plans(drafts_, stop); });
    loop_ = std::jthread([this](std::stop_token stop) { cycle(stop); });
  }

  // The scheduler has at most one question open.
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    questions_.post({std::move(question), std::move(scene), std::move(done)});
  }

  // On a thread and with a checker of its own: however long it takes, no job waits for it, and
  // verdicts on jobs do not depend on what clients have asked.
  bool consider(Question question, PlanningScenePtr scene,
                std::function<void(Verdict)> done) override {
    if (open_considered_ >= kConsideredMax) return false;
    ++open_considered_;
    considered_.post(
        {std::move(question), std::move(scene), [this, done = std::move(done)](Verdict verdict) {
           --open_considered_;
           done(std::move(verdict));
         }});
    return true;
  }

  bool draw(Drawing drawing, PlanningScenePtr scene, std::function<void(Diagram)> done) override {
    if (open_drawings_ >= kDrawingsMax) return false;
    ++open_drawings_;
    drawings_.post({std::move(drawing), std::move(scene), std::move(done)});
    return true;
  }

  void plan(PlanTask task) override { plans_.post(std::move(task)); }

  bool draft(PlanTask task) override {
    if (open_drafts_ >= kDraftsMax) return false;
    ++open_drafts_;
    task.done = [this, done = std::move(task.done)](const PlanAnswer& answer) {
      --open_drafts_;
      done(answer);
    };
    drafts_.post(std::move(task));
    return true;
  }

  void post(Task command) { commands_.post({false, std::move(command)}); }
  void post_urgent(std::function<void(Executive&)> command) {
    commands_.post({true, [command = std::move(command)](Executive& executive) {
                      command(executive);
                      return true;
                    }});
  }
  double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }

 private:
  struct Asked {
    Question question;
    PlanningScenePtr scene;
    std::function<void(Verdict)> done;
  };

  struct ToDraw {
    Drawing drawing;
    PlanningScenePtr scene;
    std::function<void(Diagram)> done;
  };

  struct Command {
    bool is_urgent;
    Task run;
  };

  void judge_questions(Inbox<Asked>& questions, std::stop_token stop) {
    std::optional<MotionChecker> checker;
    while (!stop.stop_requested()) {
      for (Asked& asked : questions.take(stop)) {
        if (stop.stop_requested()) return;
        if (!checker) checker.emplace(asked.scene);
        checker->look_at(asked.scene);
        post_urgent([verdict = checker->judge(asked.question),
                     done = std::move(asked.done)](Executive&) { done(verdict); });
      }
    }
  }

  // On a thread of its own, with its own checker: whoever looks keeps no job waiting.
  void draw_diagrams(std::stop_token stop) {
    std::optional<MotionChecker> checker;
    while (!stop.stop_requested()) {
      for (ToDraw& asked : drawings_.take(stop)) {
        if (stop.stop_requested()) return;
        if (!checker) checker.emplace(asked.scene);
        checker->look_at(asked.scene);
        post_urgent([this, diagram = checker->draw(asked.drawing),
                     done = std::move(asked.done)](Executive&) {
          --open_drawings_;
          done(diagram);
        });
      }
    }
  }

  // On threads of their own: what clients ask to be planned delays no job.
  void make_plans(Inbox<PlanTask>& tasks, std::stop_token stop) {
    while (!stop.stop_requested()) {
      for (PlanTask& task : tasks.take(stop)) {
        const std::stop_callback at_end(stop, [&task] { *task.cancelled = true; });
        post_urgent([answer = answer_plan(task.scene, task.question, task.cancelled.get()),
                     done = std::move(task.done)](Executive&) { done(answer); });
      }
    }
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
    }
  }

  // Until the next cycle is due.
  void take_inputs(const std::stop_token& stop, Wall::time_point due) {
    const Wall::time_point until = std::max(due, Wall::now() + kInputsAtLeast);
    do {
      sort_in(waiting_.empty() ? commands_.take(stop, due) : commands_.take());
      if (!waiting_.empty() && waiting_.front()(*executive_)) waiting_.pop_front();
    } while (!stop.stop_requested() && Wall::now() < (waiting_.empty() ? due : until));
  }

  // What is urgent is done at once.
  void sort_in(std::deque<Command> came) {
    for (Command& command : came) {
      if (command.is_urgent) {
        command.run(*executive_);
      } else {
        waiting_.push_back(std::move(command.run));
      }
    }
  }

  void tell_late(Wall::time_point now, Wall::duration late) {
    if (late < kTellsLate || now < tells_late_from_) return;
    tells_late_from_ = now + kTellsAgain;
    const auto late_ms = std::chrono::duration_cast<std::chrono::milliseconds>(late).count();
    executive_->alert(
        {Alert::Level::warning, "the control loop was held up for " + std::to_string(late_ms) +
                                    " ms: the machine is too busy, or something took too long"});
  }

  std::atomic<double> speed_;
  Inbox<Asked> questions_;
  Inbox<ToDraw> drawings_;
  int open_drawings_ = 0;  // the loop thread's
  Inbox<PlanTask> plans_;
  Inbox<PlanTask> drafts_;
  int open_drafts_ = 0;  // the loop thread's
  Inbox<Asked> considered_;
  int open_considered_ = 0;  // the loop thread's
  Inbox<Command> commands_;
  std::deque<Task> waiting_;  // of them, in their order; the loop thread's
  Wall::time_point tells_late_from_{};
  std::unique_ptr<Executive> executive_;  // the loop thread's
  std::jthread judge_;
  std::jthread considerer_;
  std::jthread artist_;
  std::jthread planner_;
  std::jthread drafter_;
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
double RealTimeLoop::speed() const { return impl_->speed(); }
void RealTimeLoop::set_speed(double speed) { impl_->set_speed(speed); }

}  // namespace armloom
