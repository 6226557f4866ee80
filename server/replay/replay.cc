#include "server/replay/replay.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include "core/executive/active_policy.h"
#include "core/executive/batch.h"
#include "core/executive/stepped_loop.h"
#include "server/codec/read_text.h"
#include "server/messages/job_amendment.h"
#include "server/messages/job_request.h"
#include "server/replay/input_format.h"
#include "server/replay/reported_arms.h"

namespace armloom {
namespace {

using In = ExecutiveInput;

// Largest accepted number of cycles between two lines. A line further ahead is taken as damaged: to
// run the cycles up to it would take an hour or more.
constexpr std::uint64_t kLongestPause = std::chrono::days(31) / kControlPeriod;
constexpr std::uint64_t kCyclesMax = TimePoint::max().time_since_epoch() / kControlPeriod;

Problem unreadable(const std::string& what) {
  return {ProblemKind::invalid, "bad-input-log", "", what};
}

// Returns the problem as a sentence, with its place in the line.
std::string sentence(const Problem& problem) {
  return (problem.pointer.empty() ? "" : problem.pointer + ": ") + problem.detail;
}

Problem diverged(const std::string& logged, const std::string& here) {
  return {ProblemKind::conflict, "diverged", "",
          "the replay diverged: logged " + logged + ", replayed " + here};
}

JobRequest request_of(const In::AskedJob& asked) {
  auto job = read_job_text(*asked.body);
  if (!job) throw std::invalid_argument(job.error().front().detail);
  job->body = asked.body;
  job->known.succeeded = asked.succeeded;
  return std::move(*job);
}

std::vector<JobRequest> requests_of(const std::vector<In::AskedJob>& jobs) {
  std::vector<JobRequest> requests;
  std::ranges::transform(jobs, std::back_inserter(requests), request_of);
  return requests;
}

RestoredJob restored(const In::FormerJob& former) {
  JobRequest job = request_of(former.asked);
  apply(former.amended, job);
  job.key = former.key;
  return {former.id, std::move(job), former.submitted_at};
}

}  // namespace

class Replay::Impl final : public InputLog {
 public:
  explicit Impl(CellPtr cell) : cell_(std::move(cell)) {}

  std::optional<Problems> begin(const InputLogHead& head, Observer& observer) {
    ExecutiveOptions options;
    options.policy = head.policy;
    options.seed = head.seed;
    options.first_job = JobId{head.first_job};
    options.inputs = this;
    options.controllers = arms_.controllers();
    options.write_signal = [](SignalId, const SignalValue&) {};  // devices report as recorded
    options.controllers.merge(simulated_controllers());
    auto made = SteppedLoop::create(cell_, std::move(options), observer);
    if (!made) return std::move(made.error());
    loop_ = std::move(*made);
    return std::nullopt;
  }

  void came(std::uint64_t ticks, const ExecutiveInput& input) override {
    echo_.push_back(text_of(*logged_input_format(), {ticks, input}));
  }

  Result<void> take(std::string_view text) {
    const auto line = read_text(*logged_input_format(), text);
    if (!line) return failure(unreadable(sentence(line.error().front())));
    if (line->ticks > loop_->ticks() + kLongestPause) {
      return failure(unreadable("the line is more than 31 days after the previous line"));
    }
    while (loop_->ticks() < line->ticks) loop_->tick();
    echo_.clear();
    std::visit([this](const auto& input) { comes(input); }, line->input.what);
    if (echo_.size() == 1 && echo_.front() == text) return {};
    return failure(diverged(std::string(text), echo_.empty() ? "nothing" : echo_.back()));
  }

  void run_until(TimePoint time) {
    while (loop_->next() <= time) loop_->tick();
  }

  [[nodiscard]] Executive& executive() const { return loop_->executive(); }

 private:
  [[nodiscard]] std::vector<ArmId> arms(const std::vector<std::string>& names) const {
    std::vector<ArmId> arms;
    for (const std::string& name : names) {
      const auto arm = cell_->find_arm(name);
      if (!arm) throw std::invalid_argument("the cell has no arm \"" + name + "\"");
      arms.push_back(*arm);
    }
    return arms;
  }

  // Each comes() repeats what the executive did when this input arrived.
  void comes(const In::Submitted& in) { (void)executive().submit(request_of(in.jobs.front())); }
  void comes(const In::BatchOpened& in) {
    batch_ = executive().open_batch(requests_of(in.jobs), false);
  }
  void comes(const In::AtomicBatchOpened& in) {
    batch_ = executive().open_batch(requests_of(in.jobs), true);
  }
  void comes(const In::WentOn&) {
    if (batch_) (void)batch_->go_on();
  }
  void comes(const In::Restored& in) {
    std::vector<RestoredJob> jobs;
    std::ranges::transform(in.jobs, std::back_inserter(jobs), restored);
    (void)executive().restore(std::move(jobs));
  }
  void comes(const In::Canceled& in) { (void)executive().cancel(in.job); }
  void comes(const In::RolledBack& in) { executive().roll_back(in.job); }
  void comes(const In::Held& in) { (void)executive().cancel(in.job, in.until); }
  void comes(const In::Amended& in) { (void)executive().amend(in.job, in.amendment); }
  void comes(const In::Replanned& in) { (void)executive().replan(in.job); }
  void comes(const In::Stopped& in) { executive().stop(arms(in.arms), in.cause, in.category); }
  void comes(const In::Resumed& in) { executive().resume(arms(in.arms)); }
  void comes(const In::SpeedSet& in) {
    if (!SpeedOverride::is_valid(in.share)) throw std::invalid_argument("wrong speed override");
    executive().set_speed(in.arm.empty() ? std::nullopt : std::optional(arms({in.arm}).front()),
                          in.share);
  }
  void comes(const In::PolicyChanged& in) { (void)executive().policy().change(in.policy); }
  void comes(const In::WoundDown& in) {
    executive().wind_down(in.cause, in.waiting, [] {});
  }
  void comes(const In::ObjectAdded& in) { (void)executive().scene().add(in.object); }
  void comes(const In::ObjectReplaced& in) { (void)executive().scene().replace(in.object); }
  void comes(const In::ObjectRemoved& in) { (void)executive().scene().remove(in.name); }
  void comes(const In::ObjectsSet& in) { (void)executive().scene().edit(in); }
  void comes(const In::ObjectsExpired& in) { (void)executive().scene().edit(in); }
  void comes(const In::ExpiryRestored& in) { executive().scene().restore(in); }
  void comes(const In::ObjectHeld& in) { (void)executive().scene().hold(in); }
  void comes(const In::ObjectDetached& in) { (void)executive().detach(in.object); }
  void comes(const In::Injected& in) { (void)executive().faults().inject(in.fault); }
  void comes(const In::FaultRemoved& in) { (void)executive().faults().remove(in.fault); }
  void comes(const In::Alerted& in) { executive().alert(in.alert); }
  void comes(const In::Judged& in) { loop_->answer_question(in.interrupted); }
  void comes(const In::Certified&) { loop_->answer_certify(); }
  void comes(const In::Planned&) { loop_->answer_plan(); }
  void comes(const In::StartWritten& in) { loop_->write_start(in.step.job); }
  void comes(const In::SignalSet& in) { (void)executive().signals().set(in.signal, in.value); }
  void comes(const In::IoReported& in) { executive().signals().report(in.report); }
  void comes(const In::Reported& in) { comes_from_arm(in); }
  void comes(const In::Connected& in) { comes_from_arm(in); }
  template <class Input>
  void comes_from_arm(const Input& in) {
    arms_.add(in);
    came(loop_->ticks(), {in});
  }

  CellPtr cell_;
  ReportedArms arms_;
  std::unique_ptr<SteppedLoop> loop_;
  std::shared_ptr<Executive::Batch> batch_;
  std::vector<std::string> echo_;  // inputs logged by this executive for the present line
};

Result<std::unique_ptr<Replay>> Replay::begin(CellPtr cell, std::string_view head,
                                              Observer& observer) {
  const auto read = read_text(*input_log_head_format(), head);
  if (!read) return failure(unreadable("not an input log of this version of armloom"));
  auto impl = std::make_unique<Impl>(std::move(cell));
  if (auto problems = impl->begin(*read, observer)) return failure(std::move(*problems));
  return std::unique_ptr<Replay>(new Replay(std::move(impl)));
}

Replay::Replay(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Replay::~Replay() = default;

Result<void> Replay::take(std::string_view line) {
  try {
    return impl_->take(line);
  } catch (const std::invalid_argument& fault) {
    return failure(unreadable(fault.what()));
  }
}

void Replay::run_until(TimePoint time) { impl_->run_until(time); }
const Executive& Replay::executive() const { return impl_->executive(); }

std::optional<TimePoint> Replay::time_of(std::string_view text) {
  const auto line = read_text(*logged_input_format(), text);
  if (!line || line->ticks > kCyclesMax) return std::nullopt;
  return TimePoint(static_cast<std::int64_t>(line->ticks) * kControlPeriod);
}

}  // namespace armloom
