#include "core/executive/stepped_loop.h"

#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "core/executive/own_checker.h"

namespace armloom {

class SteppedLoop::Service final : public JudgementService, public StartLog {
 public:
  void ask(Question question, PlanningScenePtr scene, std::function<void(Verdict)> done) override {
    asked_ = {std::move(question), std::move(scene), std::move(done)};
  }
  void certify(Question question, PlanningScenePtr scene,
               std::function<void(Verdict)> done) override {
    certified_ = {std::move(question), std::move(scene), std::move(done)};
  }
  bool draw(Drawing, PlanningScenePtr, std::function<void(Diagram)>) override { return false; }
  void plan(PlanTask task) override { plans_.push_back(std::move(task)); }
  bool draft(PlanTask) override { return false; }
  void about_to_move(JobId job, std::function<void()> written) override {
    starts_[job] = std::move(written);
  }
  void has_moved(JobId job, const HeldView&, std::function<void()> written) override {
    starts_[job] = std::move(written);
  }

  void answer_question(bool interrupted) { answer(asked_, checker_, interrupted); }
  void answer_certify() { answer(certified_, certifier_, false); }
  void answer_plan() {
    if (plans_.empty()) return;
    const PlanTask task = std::move(plans_.front());
    plans_.pop_front();
    task.done(answer_of(task));
  }
  void write_start(JobId job) {
    const auto node = starts_.extract(job);
    if (!node.empty()) node.mapped()();
  }

 private:
  struct Asked {
    Question question;
    PlanningScenePtr scene;
    std::function<void(Verdict)> done;
  };
  static void answer(std::optional<Asked>& open, OwnChecker& own, bool interrupted) {
    if (!open) return;
    const Asked asked = *std::exchange(open, std::nullopt);
    MotionChecker& checker = own.in(asked.scene);
    asked.done(interrupted ? checker.interrupted(asked.question) : checker.judge(asked.question));
  }
  std::optional<Asked> asked_, certified_;
  OwnChecker checker_, certifier_;
  std::deque<PlanTask> plans_;
  std::map<JobId, std::function<void()>> starts_;
};

SteppedLoop::SteppedLoop(std::unique_ptr<Service> service) : service_(std::move(service)) {}
SteppedLoop::~SteppedLoop() = default;

Result<std::unique_ptr<SteppedLoop>> SteppedLoop::create(CellPtr cell, ExecutiveOptions options,
                                                         Observer& observer) {
  std::unique_ptr<SteppedLoop> loop(new SteppedLoop(std::make_unique<Service>()));
  options.starts = loop->service_.get();
  auto executive =
      Executive::create(std::move(cell), std::move(options), *loop->service_, observer);
  if (!executive) return failure(std::move(executive.error()));
  loop->executive_ = std::move(*executive);
  return loop;
}

Executive& SteppedLoop::executive() { return *executive_; }

void SteppedLoop::tick() {
  executive_->tick(next_);
  next_ += kControlPeriod;
  ++ticks_;
}

std::uint64_t SteppedLoop::ticks() const { return ticks_; }
TimePoint SteppedLoop::next() const { return next_; }
void SteppedLoop::answer_question(bool interrupted) { service_->answer_question(interrupted); }
void SteppedLoop::answer_certify() { service_->answer_certify(); }
void SteppedLoop::answer_plan() { service_->answer_plan(); }
void SteppedLoop::write_start(JobId job) { service_->write_start(job); }

}  // namespace armloom
