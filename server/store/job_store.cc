#include "server/store/job_store.h"

#include <algorithm>
#include <condition_variable>
#include <future>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "server/store/data_lock.h"
#include "server/store/job_tables.h"
#include "server/store/store_mark.h"
#include "server/store/tables.h"
#include "server/store/watched_files.h"

namespace armloom {
namespace {

using Wall = std::chrono::steady_clock;
constexpr Wall::duration kCleaned = std::chrono::minutes(1);
constexpr Wall::duration kLookedAfter = std::chrono::seconds(1);

std::string advice(const std::runtime_error& fault) {
  const auto* of_database = dynamic_cast<const SqlFault*>(&fault);
  if (of_database != nullptr && of_database->is_full()) return "make room on the disk";
  const bool is_of_system = dynamic_cast<const std::system_error*>(&fault) != nullptr;
  if (is_of_system || (of_database != nullptr && of_database->is_of_access())) {
    return "make it readable and writable";
  }
  return "repair it, restore a copy of the folder, or move it away, with armloom.db-wal and "
         "armloom.db-shm, to start with an empty store";
}

tl::unexpected<Problems> cannot_use(const std::filesystem::path& file,
                                    const std::runtime_error& fault) {
  return failure(
      Problem{ProblemKind::unavailable, "store-unusable", "--data",
              file.string() + ": " + fault.what() + "; nothing was changed: " + advice(fault),
              file.string()});
}

void begin(const std::filesystem::path& folder, const std::string& vfs) {
  if (const auto log = log_of(folder); std::filesystem::exists(log)) {
    throw std::runtime_error("it is missing, but its log " + log.string() + " may hold jobs");
  }
  { const StoreMark first(folder, std::nullopt); }
  make_store(folder / kStoreFile, vfs);
}

}  // namespace

class JobStore::Impl {
 public:
  Impl(const std::filesystem::path& folder, std::unique_ptr<DataLock> lock,
       std::unique_ptr<JobTables> tables, StoreOptions options)
      : lock_(std::move(lock)),
        tables_(std::move(tables)),
        mark_(folder, tables_->commits()),
        files_(folder),
        options_(std::move(options)),
        leftover_(leftover_of(*tables_, mark_)),
        thread_([this](const std::stop_token& stop) { work(stop); }) {}

  void add(Pending changes) {
    {
      const std::scoped_lock lock(mutex_);
      if (is_closed_) return;
      given_up_.pass_over(changes);
      pending_.join(std::move(changes));
    }
    arrived_.notify_one();
  }

  void add_stops(std::vector<std::string> arms) {
    const std::scoped_lock in_order(stops_mutex_);
    Pending changes;
    changes.stops = {std::move(arms), mark_.stops_come()};
    add(std::move(changes));
  }

  std::optional<StoreFault> fault() const {
    const std::scoped_lock lock(mutex_);
    return fault_;
  }

  std::optional<StoreFault> close() {
    {
      const std::scoped_lock lock(mutex_);
      is_closed_ = true;
    }
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
    const std::scoped_lock lock(mutex_);
    return fault_;
  }

  const Leftover& leftover() const { return leftover_; }

 private:
  static Leftover leftover_of(const JobTables& tables, const StoreMark& mark) {
    Leftover left = tables.leftover();
    left.is_behind = mark.found().store_is_behind;
    left.is_unmarked = mark.found().is_missing;
    left.stops_are_unwritten = mark.found().stops_are_ahead;
    return left;
  }

  void work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      {
        std::unique_lock lock(mutex_);
        arrived_.wait_until(lock, stop,
                            std::min(cleaned_at_ + kCleaned, Wall::now() + kLookedAfter),
                            [this] { return !pending_.is_empty(); });
      }
      if (write_pending()) {
        // Cleans up here, too, because changes may always be pending.
        if (options_.now() >= cleaned_at_ + kCleaned) clean_up();
        continue;
      }
      std::unique_lock lock(mutex_);  // wait before the next try
      arrived_.wait_for(lock, stop, options_.retry, [] { return false; });
    }
    (void)write_pending();
  }

  // Writes all pending changes. On failure, puts them back and returns false.
  bool write_pending() {
    Pending batch;
    {
      const std::scoped_lock lock(mutex_);
      batch = std::exchange(pending_, {});
    }
    if (const auto lost = files_.lost()) {
      if (lost->is_log_cut_off) tables_->leave_log();
      give_back(std::move(batch), {false, lost->text});
      return false;
    }
    if (batch.is_empty()) return true;
    const auto begun = Wall::now();
    try {
      tables_->write(batch, since_begin());
    } catch (const SqlFault& fault) {
      give_back(std::move(batch), {fault.is_full(), fault.what()});
      return false;
    }
    files_.log_has_grown();
    mark_.written(tables_->commits(),
                  batch.stops ? std::optional(batch.stops->number) : std::nullopt);
    if (options_.on_written) options_.on_written(Wall::now() - begun);
    bool was_faulty = false;
    {
      const std::scoped_lock lock(mutex_);
      was_faulty = std::exchange(fault_, std::nullopt).has_value();
    }
    if (was_faulty && options_.on_fault) options_.on_fault(nullptr);
    for (const Pending::Acceptance& acceptance : batch.acceptances) acceptance.done(true);
    for (const Pending::Start& start : batch.starts) start.done(true);
    return true;
  }

  void give_back(Pending batch, const StoreFault& fault) {
    const auto refused = std::exchange(batch.acceptances, {});
    bool is_new = false;
    {
      const std::scoped_lock lock(mutex_);
      batch.join(std::exchange(pending_, {}));
      pending_ = std::move(batch);
      for (const Pending::Acceptance& one : refused) given_up_.add(one.jobs);
      given_up_.pass_over(pending_);
      is_new = !fault_;
      fault_ = fault;
    }
    if (is_new && options_.on_fault) options_.on_fault(&fault);
    for (const Pending::Acceptance& one : refused) one.done(false);
  }

  [[nodiscard]] std::chrono::milliseconds since_begin() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(options_.now() - steady_began_);
  }

  void clean_up() {
    cleaned_at_ = options_.now();
    try {
      if (tables_->clean_up(options_.retention, began_, since_begin())) {
        cleaned_at_ -= kCleaned;  // there is more
      }
    } catch (const SqlFault&) {  // reported by the next write
    }
  }

  std::unique_ptr<DataLock> lock_;  // destroyed last
  std::unique_ptr<JobTables> tables_;
  StoreMark mark_;
  WatchedFiles files_;
  StoreOptions options_;
  const std::chrono::system_clock::time_point began_ = std::chrono::system_clock::now();
  const Wall::time_point steady_began_ = options_.now();
  Leftover leftover_;
  std::mutex stops_mutex_;
  mutable std::mutex mutex_;
  std::condition_variable_any arrived_;
  Pending pending_;
  GivenUpJobs given_up_;
  std::optional<StoreFault> fault_;
  bool is_closed_ = false;
  Wall::time_point cleaned_at_{};  // used by the thread only
  std::jthread thread_;
};

Result<std::unique_ptr<JobStore>> JobStore::open(const std::filesystem::path& folder,
                                                 StoreOptions options) {
  auto lock = DataLock::take(folder);
  if (!lock) return failure(std::move(lock.error()));
  const std::filesystem::path file = folder / kStoreFile;
  try {
    if (!std::filesystem::exists(file)) begin(folder, options.vfs);
    auto tables = std::make_unique<JobTables>(file, options.vfs);
    return std::unique_ptr<JobStore>(new JobStore(
        std::make_unique<Impl>(folder, std::move(*lock), std::move(tables), std::move(options))));
  } catch (const std::runtime_error& fault) {
    return cannot_use(file, fault);
  }
}

JobStore::JobStore(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
JobStore::~JobStore() { (void)close(); }

const Leftover& JobStore::leftover() const { return impl_->leftover(); }

void JobStore::accept(std::vector<Accepted> jobs, Done done) {
  Pending changes;
  Pending::Acceptance acceptance{.jobs = {}, .done = std::move(done)};
  for (Accepted& accepted : jobs) {
    const std::uint64_t number = accepted.job.number;
    acceptance.jobs.push_back(number);
    JobChange change{.body = std::move(accepted.body), .origin = accepted.job.origin};
    change.seen = std::move(accepted.job);
    changes.jobs.emplace(number, std::move(change));
  }
  changes.acceptances.push_back(std::move(acceptance));
  impl_->add(std::move(changes));
}

void JobStore::see(StoredJob job) {
  Pending changes;
  const std::uint64_t number = job.number;
  changes.jobs.emplace(number, JobChange{.seen = std::move(job)});
  impl_->add(std::move(changes));
}

void JobStore::amend(std::uint64_t number, std::string amended, Done done) {
  Pending changes;
  changes.jobs.emplace(number, JobChange{.amended = std::move(amended)});
  changes.acceptances.push_back({.jobs = {}, .done = std::move(done)});
  impl_->add(std::move(changes));
}

void JobStore::about_to_move(std::uint64_t number, Done done) {
  Pending changes;
  changes.jobs.emplace(number, JobChange{.may_have_moved = true});
  changes.starts.push_back({number, std::move(done)});
  impl_->add(std::move(changes));
}

void JobStore::stopped(std::vector<std::string> arms) { impl_->add_stops(std::move(arms)); }

void JobStore::change(std::vector<StoredObject> objects, Done done) {
  Pending changes;
  for (StoredObject& object : objects) {
    changes.objects.insert_or_assign(object.name, std::move(object));
  }
  changes.acceptances.push_back({.jobs = {}, .done = std::move(done)});
  impl_->add(std::move(changes));
}

void JobStore::set_speed(StoredSpeed speed, Done done) {
  Pending changes;
  changes.speeds.emplace(speed.arm, std::move(speed));
  changes.acceptances.push_back({.jobs = {}, .done = std::move(done)});
  impl_->add(std::move(changes));
}

void JobStore::answered_with(std::uint64_t job, RequestOrigin request) {
  Pending changes;
  changes.answers.push_back({job, std::move(request)});
  impl_->add(std::move(changes));
}

void JobStore::note(AuditEntry entry) {
  Pending changes;
  changes.audit.add(std::move(entry));
  impl_->add(std::move(changes));
}

void JobStore::keep(StoredAlert alert) {
  Pending changes;
  changes.alerts.push_back(std::move(alert));
  impl_->add(std::move(changes));
}

bool JobStore::flush() {
  const auto written = std::make_shared<std::promise<bool>>();
  accept({}, [written](bool is_written) { written->set_value(is_written); });
  return written->get_future().get();
}

std::optional<StoreFault> JobStore::fault() const { return impl_->fault(); }
std::optional<StoreFault> JobStore::close() { return impl_->close(); }

}  // namespace armloom
