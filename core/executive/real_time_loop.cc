#include "core/executive/real_time_loop.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/collision/check/motion_checker.h"
#include "core/executive/worker.h"

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

// What is asked of a scene, and whom to tell.
template <class Asked, class Answer>
struct Inquiry {
  Asked asked;
  PlanningScenePtr scene;
  std::function<void(Answer)> done;
};
using ToJudge = Inquiry<Question, Verdict>;
using ToDraw = Inquiry<Drawing, Diagram>;

// The checker of one thread, made when it is first asked.
class OwnChecker {
 public:
  MotionChecker& in(const PlanningScenePtr& scene) {
    if (!checker_) checker_.emplace(scene);
    checker_->look_at(scene);
    return *checker_;
  }

 private:
  std::optional<MotionChecker> checker_;
};

}  // namespace

class RealTimeLoop::Impl final : public JudgementService {
 public:
  using Task = RealTimeLoop::Task;

  explicit Impl(double speed) : speed_(speed) {}

  ~Impl() override {
    // The workers first: they post into the loop's inbox.
    judge_.end();
    considerer_.end();
    artist_.end();
    planner_.end();
    drafter_.end();
    if (!loop_.joinable()) return;
    loop_.request_stop();
    loop_.join();
  }

  // Each worker has its own checker: however long it takes, no job waits for what clients ask, and
  // verdicts on jobs do not depend on it.
  void run(std::unique_ptr<Executive> executive) {
    executive_ = std::move(executive);
    for (Worker<ToJudge>* worker : {&judge_, &considerer_}) {
      worker->run([this, checker = std::make_shared<OwnChecker>()](ToJudge& judged, auto) {
        post_urgent([verdict = checker->in(judged.scene).judge(judged.asked),
                     done = std::move(judged.done)](Executive&) { done(verdict); });
      });
    }
    artist_.run([this, checker = std::make_shared<OwnChecker>()](ToDraw& drawn, auto) {
      post_urgent([diagram = checker->in(drawn.scene).draw(drawn.asked),
                   done = std::move(drawn.done)](Executive&) { done(diagram); });
    });
    for (Worker<PlanTask>* worker : {&planner_, &drafter_}) {
      worker->run([this](PlanTask& task, std::stop_token stop) {
        const std::stop_callback at_end(stop, [&task] { *task.cancelled = true; });
        post_urgent([answer = answer_plan(task.scene, task.question, task.cancelled.get()),
                     done = std::move(task.done)](Executive&) { done(answer); });
      });
    }
    loop_ = std::jthread([this](std::stop_token stop) { cycle(stop); });
  }

  // The scheduler has at most one question open.
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    judge_.post({std::move(question), std::move(scene), std::move(done)});
  }

  bool consider(Question question, PlanningScenePtr scene,
                std::function<void(Verdict)> done) override {
    if (open_.considered >= kConsideredMax) return false;
    considerer_.post(
        {std::move(question), std::move(scene), counted(open_.considered, std::move(done))});
    return true;
  }

  bool draw(Drawing drawing, PlanningScenePtr scene, std::function<void(Diagram)> done) override {
    if (open_.drawings >= kDrawingsMax) return false;
    artist_.post({std::move(drawing), std::move(scene), counted(open_.drawings, std::move(done))});
    return true;
  }

  void plan(PlanTask task) override { planner_.post(std::move(task)); }

  bool draft(PlanTask task) override {
    if (open_.drafts >= kDraftsMax) return false;
    task.done = counted(open_.drafts, std::move(task.done));
    drafter_.post(std::move(task));
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
  struct Command {
    bool is_urgent;
    Task run;
  };

  // One more is open until it is done.
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
  Worker<ToJudge> judge_;
  Worker<ToJudge> considerer_;
  Worker<ToDraw> artist_;
  Worker<PlanTask> planner_;
  Worker<PlanTask> drafter_;
  struct Open {  // asked for and not done; the loop thread's
    int considered = 0;
    int drawings = 0;
    int drafts = 0;
  };
  Open open_;
  Inbox<Command> commands_;
  std::deque<Task> waiting_;  // of them, in their order; the loop thread's
  Wall::time_point tells_late_from_{};
  std::unique_ptr<Executive> executive_;  // the loop thread's
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
