#include "core/executive/real_time_loop.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
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
// And so many plans of clients.
constexpr int kDraftsMax = 16;

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

// A thread with an inbox: does one item after the other until it is told to stop, or destroyed.
template <class Item>
class Worker {
 public:
  using Work = std::function<void(Item&, std::stop_token)>;

  void run(Work work) {
    thread_ = std::jthread([this, work = std::move(work)](std::stop_token stop) {
      while (!stop.stop_requested()) {
        for (Item& item : inbox_.take(stop)) {
          if (stop.stop_requested()) return;
          work(item, stop);
        }
      }
    });
  }
  void post(Item item) { inbox_.post(std::move(item)); }
  void end() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

 private:
  Inbox<Item> inbox_;
  std::jthread thread_;
};

// What is asked of a scene, on a thread with a checker of its own.
template <class Asked, class Answer>
struct Inquiry {
  Asked asked;
  PlanningScenePtr scene;
  std::function<void(Answer)> done;
};
using Inquired = Inquiry<Question, Verdict>;
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
  explicit Impl(double speed) : speed_(speed) {}

  ~Impl() override {
    // The workers first: they post into the loop's inbox.
    judge_.end();
    artist_.end();
    planner_.end();
    drafter_.end();
    if (!loop_.joinable()) return;
    loop_.request_stop();
    loop_.join();
  }

  void run(std::unique_ptr<Executive> executive) {
    executive_ = std::move(executive);
    judge_.run([this, checker = std::make_shared<OwnChecker>()](Inquired& inquired, auto) {
      post([verdict = checker->in(inquired.scene).judge(inquired.asked),
            done = std::move(inquired.done)](Executive&) { done(verdict); });
    });
    // With its own checker: whoever looks keeps no job waiting.
    artist_.run([this, checker = std::make_shared<OwnChecker>()](ToDraw& drawn, auto) {
      post([this, diagram = checker->in(drawn.scene).draw(drawn.asked),
            done = std::move(drawn.done)](Executive&) {
        --open_drawings_;
        done(diagram);
      });
    });
    const auto make_plan = [this](PlanTask& task, std::stop_token stop) { answer(task, stop); };
    planner_.run(make_plan);
    drafter_.run(make_plan);  // what clients ask to be planned delays no job
    loop_ = std::jthread([this](std::stop_token stop) { cycle(stop); });
  }

  // The scheduler has at most one question open; what else comes in are clients' checks.
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    judge_.post({std::move(question), std::move(scene), std::move(done)});
  }

  bool draw(Drawing drawing, PlanningScenePtr scene, std::function<void(Diagram)> done) override {
    if (open_drawings_ >= kDrawingsMax) return false;
    ++open_drawings_;
    artist_.post({std::move(drawing), std::move(scene), std::move(done)});
    return true;
  }

  void plan(PlanTask task) override { planner_.post(std::move(task)); }

  bool draft(PlanTask task) override {
    if (open_drafts_ >= kDraftsMax) return false;
    ++open_drafts_;
    task.done = [this, done = std::move(task.done)](const PlanAnswer& answer) {
      --open_drafts_;
      done(answer);
    };
    drafter_.post(std::move(task));
    return true;
  }

  void post(std::function<void(Executive&)> command) { commands_.post(std::move(command)); }
  double speed() const { return speed_; }
  void set_speed(double speed) { speed_ = speed; }

 private:
  void answer(PlanTask& task, std::stop_token stop) {
    const std::stop_callback at_end(stop, [&task] { *task.cancelled = true; });
    post([answer = answer_plan(task.scene, task.question, task.cancelled.get()),
          done = std::move(task.done)](Executive&) { done(answer); });
  }

  void cycle(std::stop_token stop) {
    Wall::time_point due = Wall::now();
    TimePoint cell_now{};
    while (!stop.stop_requested()) {
      for (auto& command : commands_.take(stop, due)) command(*executive_);
      const Wall::time_point wall_now = Wall::now();
      if (wall_now - due > kCatchUpMax) due = wall_now;
      const auto wall_period = std::chrono::duration_cast<Wall::duration>(
          std::chrono::duration<double, std::nano>(kControlPeriod) / speed_.load());
      for (; due <= wall_now; due += wall_period) {
        executive_->tick(cell_now);
        cell_now += kControlPeriod;
      }
    }
  }

  std::atomic<double> speed_;
  Worker<Inquired> judge_;
  Worker<ToDraw> artist_;
  Worker<PlanTask> planner_;
  Worker<PlanTask> drafter_;
  int open_drawings_ = 0;  // the loop thread's
  int open_drafts_ = 0;    // the loop thread's
  Inbox<std::function<void(Executive&)>> commands_;
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
  impl_->post(std::move(command));
}
double RealTimeLoop::speed() const { return impl_->speed(); }
void RealTimeLoop::set_speed(double speed) { impl_->set_speed(speed); }

}  // namespace armloom
