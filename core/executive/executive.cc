// The public face of what stands in executive_impl.h.
#include "core/executive/executive.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/batch.h"
#include "core/executive/executive_impl.h"
#include "core/executive/status_board.h"
#include "core/executive/timeline.h"

namespace armloom {
namespace {

ExecutiveInput::AskedJob asked(const JobRequest& request) {
  return {request.known.succeeded, request.body};
}

}  // namespace

Executive::Executive(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Executive::~Executive() = default;

Result<JobView> Executive::submit(JobRequest request) {
  impl_->note({ExecutiveInput::Submitted{{asked(request)}}});
  return impl_->submit(std::move(request));
}
std::shared_ptr<Executive::Batch> Executive::open_batch(std::vector<JobRequest> requests,
                                                        bool atomic) {
  std::vector<ExecutiveInput::AskedJob> jobs;
  std::ranges::transform(requests, std::back_inserter(jobs), asked);
  impl_->note(atomic ? ExecutiveInput{ExecutiveInput::AtomicBatchOpened{std::move(jobs)}}
                     : ExecutiveInput{ExecutiveInput::BatchOpened{std::move(jobs)}});
  return std::make_shared<Batch>(*impl_, std::move(requests), atomic);
}
std::optional<Executive::BatchAnswers> Executive::Batch::go_on() {
  executive.note({ExecutiveInput::WentOn{}});
  return executive.go_on(*this);
}
void Executive::check(JobRequest request, std::function<void(Result<CheckView>)> done) {
  impl_->check(std::move(request), std::move(done));
}
void Executive::plan(PlanInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                     std::function<void(Result<PlanOutcome>)> done) {
  impl_->plan(std::move(inquiry), std::move(cancelled), std::move(done));
}
void Executive::plan(StepsInquiry inquiry, std::shared_ptr<std::atomic<bool>> cancelled,
                     std::function<void(Result<StepsPlan>)> done) {
  impl_->plan(std::move(inquiry), std::move(cancelled), std::move(done));
}
void Executive::diagram(const std::string& key_a, const std::string& key_b,
                        std::function<void(Result<DiagramView>)> done) {
  impl_->questions_.drawings().draw({key_a, key_b, impl_->scene_.now(), impl_->clock_.now},
                                    std::move(done));
}
Result<JobView> Executive::cancel(const std::string& key, std::optional<TimePoint> at) {
  impl_->note(at ? ExecutiveInput{ExecutiveInput::Held{key, *at}}
                 : ExecutiveInput{ExecutiveInput::Canceled{key}});
  return impl_->cancel(key, at);
}
void Executive::roll_back(const std::string& key) {
  impl_->note({ExecutiveInput::RolledBack{key}});
  impl_->roll_back(key);
}
Result<JobView> Executive::amend(const std::string& key, JobAmendment amendment) {
  impl_->note({ExecutiveInput::Amended{key, amendment}});
  return impl_->amend(key, std::move(amendment));
}
Result<JobView> Executive::replan(const std::string& key) {
  impl_->note({ExecutiveInput::Replanned{key}});
  return impl_->replan(key);
}
void Executive::alert(Alert alert) {
  impl_->note({ExecutiveInput::Alerted{alert}});
  impl_->publisher_.tell(std::move(alert), impl_->clock_.now);
}
void Executive::stop(const std::vector<ArmId>& arms, const std::string& cause,
                     StopCategory category) {
  impl_->note({ExecutiveInput::Stopped{each_name(*impl_->cell_, arms), cause, category}});
  impl_->stop(arms, cause, Alert::Level::warning, category);
}
std::vector<ArmId> Executive::resume(const std::vector<ArmId>& arms) {
  impl_->note({ExecutiveInput::Resumed{each_name(*impl_->cell_, arms)}});
  return impl_->resume(arms);
}
void Executive::set_speed(std::optional<ArmId> arm, double share) {
  const Cell& cell = *impl_->cell_;
  impl_->note({ExecutiveInput::SpeedSet{arm ? cell.arm(*arm).name : std::string(), share}});
  impl_->set_speed(arm, share);
}
Result<CollisionObject> Executive::detach(const std::string& object) {
  impl_->note({ExecutiveInput::ObjectDetached{object}});
  return impl_->detach(object);
}
void Executive::wind_down(const std::string& cause, Waiting waiting, std::function<void()> done) {
  impl_->note({ExecutiveInput::WoundDown{cause, waiting}});
  impl_->end(cause, waiting == Waiting::is_kept, std::move(done));
}
std::vector<Result<JobView>> Executive::restore(std::vector<RestoredJob> jobs) {
  std::vector<ExecutiveInput::FormerJob> former;
  former.reserve(jobs.size());
  for (const auto& [id, request, submitted_at] : jobs) {
    former.push_back(
        {id, request.key, submitted_at, {request.name, amendable(request.terms)}, asked(request)});
  }
  impl_->note({ExecutiveInput::Restored{std::move(former)}});
  return impl_->restore(std::move(jobs));
}
LiveScene& Executive::scene() { return impl_->scene_; }
ArmFaults& Executive::faults() { return impl_->execution_.faults(); }
Signals& Executive::signals() { return impl_->signals_; }
std::optional<JobView> Executive::job(const std::string& key) const { return impl_->job(key); }
std::shared_ptr<const StatusBoard> Executive::board() const { return impl_->publisher_.board(); }
Snapshot Executive::snapshot(std::size_t ended_max) const {
  const Status status = impl_->publisher_.board()->read();
  Snapshot snapshot = snapshot_of(status, *impl_->cell_);
  for (const auto& job : status.jobs_with_ended(ended_max)) snapshot.jobs.push_back(*job);
  return snapshot;
}
TrajectoryPtr Executive::trajectory(const std::string& key) const {
  const auto id = impl_->jobs_.find(key);
  if (!id) return nullptr;
  return impl_->scheduler_.find(impl_->tasks_.motion_of(*id))->trajectory;
}
std::vector<ArmView> Executive::arms() const { return impl_->publisher_.arms(); }
TimelineView Executive::timeline() const {
  const Scheduler& scheduler = impl_->scheduler_;
  return {scheduler.timeline(impl_->clock_.now), scheduler.policy().lookahead.horizon,
          impl_->publisher_.board()->read()};
}
TimePoint Executive::now() const { return impl_->clock_.now; }
bool Executive::all_ended() const { return impl_->jobs_.active() == 0; }
TimePoint Executive::settled_until() const { return impl_->settled_until(); }
const RunFigures& Executive::figures() const { return impl_->count_.figures(); }
void Executive::tick(TimePoint now) { impl_->tick(now); }

Executive::BatchAnswers submit_batch(Executive& executive, std::vector<JobRequest> requests,
                                     bool atomic) {
  const auto batch = executive.open_batch(std::move(requests), atomic);
  for (;;) {
    if (auto answers = batch->go_on()) return std::move(*answers);
  }
}

void stop_all(Executive& executive, const std::string& cause, StopCategory category) {
  executive.stop(all_arms(executive.scene().scene()->cell()), cause, category);
}

std::vector<ArmId> resume_all(Executive& executive) {
  return executive.resume(all_arms(executive.scene().scene()->cell()));
}

}  // namespace armloom
