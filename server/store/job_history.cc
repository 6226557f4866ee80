#include "server/store/job_history.h"

#include <algorithm>
#include <utility>

#include "server/store/database.h"
#include "server/store/tables.h"

namespace armloom {
namespace {

constexpr auto kAny = std::uint64_t{1} << 62U;

const std::string kColumns =
    std::string(
        "SELECT job.number, job.id, state, has_ended, submitted_ms, ended_ms, arms, view, digest, "
        "request_key, request_digest, request_place, sum IS NOT ") +
    kSumOfJob + " FROM job ";

StoredJob row_of(const Statement& row) {
  return {
      .number = static_cast<std::uint64_t>(row.number(0)),
      .id = row.text(1),
      .state = row.text(2),
      .has_ended = row.number(3) != 0,
      .submitted_ms = row.maybe_number(4),
      .ended_ms = row.maybe_number(5),
      .arms = row.text(6),
      .view = row.text(7),
      .origin = {row.text(8), row.text(9), row.text(10), static_cast<std::size_t>(row.number(11))}};
}

bool is_damaged(const Statement& row) { return row.number(12) != 0; }

StoredJob whole_row_of(const Statement& row) {
  if (!is_damaged(row)) return row_of(row);
  throw SqlFault(0, "job \"" + row.text(1) + "\" is damaged (wrong checksum)");
}

}  // namespace

class JobHistory::Impl {
 public:
  explicit Impl(const std::filesystem::path& file)
      : file_(file), database_(file, Database::Access::read) {
    check_version(database_);
    database_.know_checksum();
    // throws if the file is not a store
    (void)database_.number("SELECT count(*) FROM job WHERE number = 0");
  }

  template <class Read>
  auto reading(Read read) const -> Result<decltype(read())> {
    try {
      return read();
    } catch (const SqlFault& fault) {
      return cannot_read(fault.what());
    }
  }

  std::optional<StoredJob> find(const std::string& id) const {
    Statement row =
        database_.prepare(kColumns + "WHERE id = ?1 AND view != '' ORDER BY number DESC LIMIT 1");
    row.bind_all(std::string_view(id));
    return row.step() ? std::optional(whole_row_of(row)) : std::nullopt;
  }

  std::vector<StoredJob> of_request(const std::string& key) const {
    Statement row = database_.prepare(
        kColumns + "WHERE request_key = ?1 AND view != '' ORDER BY request_place, number");
    row.bind_all(std::string_view(key));
    std::vector<StoredJob> jobs;
    while (row.step()) jobs.push_back(whole_row_of(row));
    Statement answered = database_.prepare(
        std::string("SELECT job, digest, place FROM request WHERE key = ?1 AND sum = ") +
        kSumOfRequest);
    answered.bind_all(std::string_view(key));
    Statement job = database_.prepare(kColumns + "WHERE number = ?1");
    while (answered.step()) {
      job.bind_all(answered.number(0));
      while (job.step()) {
        StoredJob& known = jobs.emplace_back(whole_row_of(job));
        known.origin.key = key;
        known.origin.key_digest = answered.text(1);
        known.origin.place = static_cast<std::size_t>(answered.number(2));
      }
    }
    return jobs;
  }

  AuditEntries audit(const AuditFilter& filter, std::size_t most) const {
    Statement row = database_.prepare(
        std::string("SELECT number, at_ms, who, peer, method, path, status, sum IS NOT ") +
        kSumOfAudit +
        " AS is_damaged FROM audit WHERE number < ?1 AND (is_damaged OR ((?2 OR who = ?3) AND "
        "(?4 = '' OR peer = ?4) AND (?5 = '' OR method = upper(?5)) AND substr(path, 1, "
        "length(?6)) = ?6 "
        "AND status = coalesce(?7, status) AND at_ms >= coalesce(?8, at_ms) AND (?9 IS NULL OR "
        "at_ms < ?9))) ORDER BY number DESC");
    const auto below = static_cast<std::int64_t>(std::min(filter.below.value_or(kAny), kAny));
    const std::string who = filter.who.value_or("");
    const auto status = filter.status ? std::optional<std::int64_t>(*filter.status) : std::nullopt;
    row.bind_all(below, std::int64_t{!filter.who}, std::string_view(who),
                 std::string_view(filter.from), std::string_view(filter.method),
                 std::string_view(filter.path), status, filter.since_ms, filter.before_ms);
    AuditEntries found;
    while (found.entries.size() < most && row.step()) {
      if (row.number(7) != 0) {
        ++found.damaged;
        continue;
      }
      found.entries.push_back({static_cast<std::uint64_t>(row.number(0)), row.number(1),
                               row.text(2), row.text(3), row.text(4), row.text(5),
                               static_cast<int>(row.number(6))});
    }
    return found;
  }

  Damage damage() const {
    Damage found;
    const auto count = [this](const char* table, const char* sum) {
      return static_cast<std::size_t>(database_.number(std::string("SELECT count(*) FROM ") +
                                                       table + " WHERE sum IS NOT " + sum));
    };
    found.alerts = count("alert", kSumOfAlert);
    found.audit = count("audit", kSumOfAudit);
    Statement row =
        database_.prepare(std::string("SELECT id FROM job WHERE sum IS NOT ") + kSumOfJob);
    while (row.step()) found.jobs.push_back(row.text(0));
    return found;
  }

  // Passes the selected jobs to `take` until `take` returns false. Skips damaged jobs and returns
  // their number.
  std::size_t each(const HistoryFilter& filter, const char* order,
                   const std::function<bool(StoredJob)>& take) const {
    Statement rows = database_.prepare(
        kColumns +
        "WHERE view != '' AND (?1 = '' OR state = ?1) AND (?2 = '' OR EXISTS (SELECT 1 FROM "
        "json_each(iif(json_valid(arms), arms, '[]')) WHERE value = ?2)) AND number < ?3 AND "
        "coalesce(submitted_ms, 0) >= ?4 "
        "ORDER BY number " +
        order);
    const auto before = static_cast<std::int64_t>(std::min(filter.before.value_or(kAny), kAny));
    rows.bind_all(std::string_view(filter.state), std::string_view(filter.arm), before,
                  filter.since_ms.value_or(-static_cast<std::int64_t>(kAny)));
    std::size_t damaged = 0;
    while (rows.step()) {
      if (is_damaged(rows)) {
        ++damaged;
      } else if (!take(row_of(rows))) {
        break;
      }
    }
    return damaged;
  }

  tl::unexpected<Problems> cannot_read(const std::string& why) const {
    return cannot_read(file_, why);
  }
  static tl::unexpected<Problems> cannot_read(const std::filesystem::path& file,
                                              const std::string& why) {
    return failure(Problem{ProblemKind::unavailable, "store-unreadable", "--data",
                           file.string() + " cannot be read: " + why, file.string()});
  }

 private:
  std::filesystem::path file_;
  Database database_;
};

Result<std::unique_ptr<JobHistory>> JobHistory::open(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kStoreFile;
  try {
    return std::unique_ptr<JobHistory>(new JobHistory(std::make_unique<Impl>(file)));
  } catch (const std::runtime_error& fault) {
    return Impl::cannot_read(file, fault.what());
  }
}

JobHistory::JobHistory(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
JobHistory::~JobHistory() = default;

Result<std::optional<StoredJob>> JobHistory::find(const std::string& id) const {
  return impl_->reading([&] { return impl_->find(id); });
}

Result<std::vector<StoredJob>> JobHistory::of_request(const std::string& key) const {
  return impl_->reading([&] { return impl_->of_request(key); });
}

Result<AuditEntries> JobHistory::audit(const AuditFilter& filter, std::size_t most) const {
  return impl_->reading([&] { return impl_->audit(filter, most); });
}

Result<void> JobHistory::newest_first(const HistoryFilter& filter,
                                      const std::function<bool(StoredJob)>& take) const {
  auto read = impl_->reading([&] { return impl_->each(filter, "DESC", take); });
  if (!read) return failure(std::move(read.error()));
  return {};
}

Result<void> JobHistory::oldest_first(const HistoryFilter& filter,
                                      const std::function<void(StoredJob)>& take) const {
  auto read = impl_->reading([&] {
    return impl_->each(filter, "ASC", [&](StoredJob job) {
      take(std::move(job));
      return true;
    });
  });
  if (!read) return failure(std::move(read.error()));
  if (*read == 0) return {};
  return impl_->cannot_read(std::to_string(*read) + " jobs are damaged (wrong checksum)");
}

Result<Damage> JobHistory::damage() const {
  return impl_->reading([&] { return impl_->damage(); });
}

}  // namespace armloom
