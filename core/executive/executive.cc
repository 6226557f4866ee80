// Forwards all calls to the modules in executive_impl.h.
#include "core/executive/executive.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/executive/arms_of.h"
#include "core/executive/batch.h"
#include "core/executive/executive_impl.h"
#include "core/executive/status_board.h"

namespace armloom {
namespace {

ExecutiveInput::AskedJob asked(const JobRequest& request) {
  return {request.known.succeeded, request.body};
}

}  // namespace

Executive::Executive(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Executive::~Executive() = default;

Result<JobView> Executive::submit(JobRequest request) {
  impl_->clock_.note({ExecutiveInput::Submitted{{asked(request)}}});
  return impl_->clients_.desk.submit(std::move(request));
}
std::shared_ptr<Executive::Batch> Executive::open_batch(std::vector<JobRequest> requests,
                                                        bool atomic) {
  std::vector<ExecutiveInput::AskedJob> jobs;
  std::ranges::transform(requests, std::back_inserter(jobs), asked);
  impl_->clock_.note(atomic ? ExecutiveInput{ExecutiveInput::AtomicBatchOpened{std::move(jobs)}}
                            : ExecutiveInput{ExecutiveInput::BatchOpened{std::move(jobs)}});
  return std::make_shared<Batch>(*impl_, std::move(requests), atomic);
}
std::optional<Executive::BatchAnswers> Executive::Batch::go_on() {
  executive.clock_.note({ExecutiveInput::WentOn{}});
  return executive.clients_.desk.go_on(*this);
}
Result<JobView> Executive::cancel(const std::string& key, std::optional<TimePoint> at) {
  impl_->clock_.note(at ? ExecutiveInput{ExecutiveInput::Held{key, *at}}
                        : ExecutiveInput{ExecutiveInput::Canceled{key}});
  return impl_->clients_.desk.cancel(key, at);
}
void Executive::roll_back(const std::string& key) {
  impl_->clock_.note({ExecutiveInput::RolledBack{key}});
  impl_->clients_.desk.roll_back(key);
}
Result<JobView> Executive::amend(const std::string& key, JobAmendment amendment) {
  impl_->clock_.note({ExecutiveInput::Amended{key, amendment}});
  return impl_->clients_.desk.amend(key, std::move(amendment));
}
Result<JobView> Executive::replan(const std::string& key) {
  impl_->clock_.note({ExecutiveInput::Replanned{key}});
  return impl_->clients_.desk.replan(key);
}
void Executive::alert(Alert alert) {
  impl_->clock_.note({ExecutiveInput::Alerted{alert}});
  impl_->publisher_.tell(std::move(alert), impl_->clock_.now);
}
void Executive::stop(const std::vector<ArmId>& arms, const std::string& cause,
                     StopCategory category) {
  impl_->clock_.note({ExecutiveInput::Stopped{each_name(*impl_->cell_, arms), cause, category}});
  impl_->stop(arms, cause, Alert::Level::warning, category);
}
std::vector<ArmId> Executive::resume(const std::vector<ArmId>& arms) {
  impl_->clock_.note({ExecutiveInput::Resumed{each_name(*impl_->cell_, arms)}});
  return impl_->resume(arms);
}
void Executive::set_speed(std::optional<ArmId> arm, double share) {
  const Cell& cell = *impl_->cell_;
  impl_->clock_.note({ExecutiveInput::SpeedSet{arm ? cell.arm(*arm).name : std::string(), share}});
  impl_->set_speed(arm, share);
}
Result<CollisionObject> Executive::detach(const std::string& object) {
  impl_->clock_.note({ExecutiveInput::ObjectDetached{object}});
  return impl_->clients_.tasks.detach(object);
}
void Executive::wind_down(const std::string& cause, Waiting waiting, std::function<void()> done) {
  impl_->clock_.note({ExecutiveInput::WoundDown{cause, waiting}});
  impl_->end(cause, waiting == Waiting::is_kept, std::move(done));
}
std::vector<Result<JobView>> Executive::restore(std::vector<RestoredJob> jobs) {
  std::vector<ExecutiveInput::FormerJob> former;
  former.reserve(jobs.size());
  for (const auto& [id, request, submitted_at] : jobs) {
    former.push_back(
        {id, request.key, submitted_at, {request.name, amendable(request.terms)}, asked(request)});
  }
  impl_->clock_.note({ExecutiveInput::Restored{std::move(former)}});
  return impl_->clients_.desk.restore(std::move(jobs));
}
Inquiries& Executive::inquiries() { return impl_->clients_.inquiries; }
LiveScene& Executive::scene() { return impl_->scene_; }
ArmFaults& Executive::faults() { return impl_->execution_.faults(); }
Signals& Executive::signals() { return impl_->signals_; }
std::optional<JobView> Executive::job(const std::string& key) const {
  return impl_->clients_.desk.job(key);
}
std::shared_ptr<const StatusBoard> Executive::board() const { return impl_->publisher_.board(); }
Snapshot Executive::snapshot(std::size_t ended_max) const {
  const Status status = impl_->publisher_.board()->read();
  Snapshot snapshot = snapshot_of(status, *impl_->cell_);
  for (const auto& job : status.jobs_with_ended(ended_max)) snapshot.jobs.push_back(*job);
  return snapshot;
}
std::vector<ArmView> Executive::arms() const { return impl_->publisher_.arms().views(); }
TimePoint Executive::now() const { return impl_->clock_.now; }
bool Executive::all_ended() const { return impl_->jobs_.active() == 0; }
TimePoint Executive::settled_until() const { return impl_->settled_until(); }
const RunFigures& Executive::figures() const { return impl_->clock_.count.figures(); }
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
