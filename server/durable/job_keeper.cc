#include "server/durable/job_keeper.h"

#include <chrono>

#include "server/codec/json_writer.h"
#include "server/codec/read_text.h"
#include "server/messages/job.h"
#include "server/messages/job_amendment.h"
#include "server/messages/stored_scene.h"

namespace armloom {
Result<std::unique_ptr<JobKeeper>> JobKeeper::open(const std::filesystem::path& folder,
                                                   StoreOptions options) {
  auto store = JobStore::open(folder, std::move(options));
  if (!store) return failure(std::move(store.error()));
  std::unique_ptr<JobKeeper> keeper(new JobKeeper());
  keeper->store_ = std::move(*store);
  for (auto* reader : {&keeper->history_, &keeper->lists_}) {
    auto history = JobHistory::open(folder);
    if (!history) return failure(std::move(history.error()));
    *reader = std::move(*history);
  }
  return keeper;
}

Result<void> JobKeeper::look_up(JobRequest& job) const {
  if (!job.key.empty()) {
    const auto found = history_->find(job.key);
    if (!found) return failure(found.error());
    if (*found && (*found)->has_ended) {
      return failure(Problem{ProblemKind::conflict, "id-in-use", "/id",
                             "id \"" + job.key + "\" belongs to a job that has ended", job.key});
    }
  }
  for (const std::string& before : job.after) {
    const auto found = history_->find(before);
    if (!found) return failure(found.error());
    if (*found && (*found)->state == to_string(JobState::succeeded))
      job.known.succeeded.push_back(before);
  }
  return {};
}

StoredJob row_of(const JobView& job, const WallClock& clock) {
  StoredJob stored{.number = job.id.value(),
                   .id = job.key,
                   .state = to_string(job.state),
                   .has_ended = is_terminal(job.state),
                   .submitted_ms = since_1970_ms(clock.wall_at(job.times.submitted_at)),
                   .arms = JsonWriter().value(job.arms).take(),
                   .view = text_of(*job_format(), job, &clock)};
  if (job.times.ended_at) stored.ended_ms = since_1970_ms(clock.wall_at(*job.times.ended_at));
  return stored;
}

void JobKeeper::see(const JobView& job) { store_->see(row_of(job, *clock_)); }

void JobKeeper::accept(std::vector<AcceptedJob> jobs,
                       std::function<void(std::optional<Refusal>)> then) {
  std::vector<JobStore::Accepted> accepted;
  std::vector<std::string> keys;
  for (auto& [job, body, origin, made] : jobs) {
    StoredJob row = made ? *std::move(made) : row_of(job, *clock_);
    row.origin = std::move(origin);
    accepted.push_back({std::move(row), std::move(body)});
    keys.push_back(job.key);
  }
  store_->accept(std::move(accepted),
                 [this, keys = std::move(keys), then = std::move(then)](bool is_written) {
                   if (!is_written) {
                     loop_->post_urgent([keys](Executive& executive) {
                       for (const std::string& key : keys) executive.roll_back(key);
                     });
                   }
                   tell(is_written, then);
                 });
}

void JobKeeper::tell(bool is_written,
                     const std::function<void(std::optional<Refusal>)>& then) const {
  post_([this, is_written, then] { then(is_written ? std::nullopt : refusal()); });
}

void JobKeeper::amend(const JobView& job, std::function<void(std::optional<Refusal>)> then) {
  store_->amend(job.id.value(), text_of(*job_amendment_format(), amendable_of(job)),
                [this, then = std::move(then)](bool is_written) { tell(is_written, then); });
}

void JobKeeper::change(std::vector<StoredObject> objects,
                       std::function<void(std::optional<Refusal>)> then) {
  store_->change(std::move(objects),
                 [this, then = std::move(then)](bool is_written) { tell(is_written, then); });
}

void JobKeeper::forget(const std::vector<std::string>& expired) {
  if (expired.empty()) return;
  std::vector<StoredObject> gone;
  for (const std::string& name : expired) gone.push_back({.name = name});
  store_->change(std::move(gone), [](bool) {});
}

void JobKeeper::set_speed(std::string arm, SpeedShare speed,
                          std::function<void(std::optional<Refusal>)> then) {
  store_->set_speed({std::move(arm), text_of(*speed_override_format(), speed)},
                    [this, then = std::move(then)](bool is_written) { tell(is_written, then); });
}

void JobKeeper::when_written(std::function<void(std::optional<Refusal>)> then) {
  store_->accept({}, [this, then = std::move(then)](bool is_written) { tell(is_written, then); });
}

std::optional<Refusal> JobKeeper::refusal() const {
  const auto fault = store_->fault();
  if (!fault) return std::nullopt;
  return Refusal{
      fault->is_full ? 507 : 503, fault->is_full ? "storage-full" : "storage-failed",
      "jobs cannot be stored at present, so none is accepted and no arm starts: " + fault->text,
      "--data", fault->text};
}

void JobKeeper::about_to_move(JobId job, std::function<void()> written) {
  store_->about_to_move(job.value(), [loop = loop_, written = std::move(written)](bool) {
    loop->post_urgent([written](Executive&) { written(); });
  });
}

// If the store cannot be written, all arms are stopped, and this is tried again.
void JobKeeper::has_moved(JobId job, const HeldView& object, std::function<void()> written) {
  std::vector<StoredObject> changed{{.name = object.object.name, .text = text_of_place(object)}};
  const auto stored = [this, job, object, written = std::move(written)](bool is_written) {
    if (!is_written) return has_moved(job, object, written);
    loop_->post_urgent([written](Executive&) { written(); });
  };
  store_->change(std::move(changed), stored);
}

}  // namespace armloom
