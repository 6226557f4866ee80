#include "server/store/job_tables.h"

#include <algorithm>

#include "server/store/tables.h"

namespace armloom {
namespace {

constexpr std::int64_t kCleanedAtOnce = 1000;

Database opened(const std::filesystem::path& file, const std::string& vfs) {
  // Does not even open an empty file: SQLite would delete its log, which may hold jobs.
  if (std::filesystem::file_size(file) == 0) {
    throw std::runtime_error("it is corrupt: it is empty, but a store never is");
  }
  Database database(file, Database::Access::write, vfs);
  if (database.is_read_only()) throw SqlFault(SqlFault::kNoAccess, "it is read-only");
  database.keep_log(true);  // until all checks have passed: the log of an unusable file is kept
  check_store(database);
  database.know_checksum();
  if (database.text("PRAGMA journal_mode = WAL") != "wal") {
    throw SqlFault(SqlFault::kNoAccess,
                   "write-ahead logging (WAL) does not work there, as on a network file system");
  }
  upgrade(database);
  // Jobs that ended in this session, with the time since its begin. In memory only.
  database.run(
      "PRAGMA temp_store = MEMORY; CREATE TEMP TABLE ended_now(number INTEGER PRIMARY KEY, at_ms "
      "INTEGER NOT NULL)");
  database.run("PRAGMA synchronous = FULL; PRAGMA journal_size_limit = " +
               std::to_string(JobTables::kLogKept));
  return database;
}

// Counts the requests whose jobs are lost.
constexpr const char* kLostJobs =
    "SELECT count(*) FROM body WHERE number NOT IN (SELECT number FROM job)";
constexpr const char* kForgetLostJobs =
    "DELETE FROM body WHERE number NOT IN (SELECT number FROM job)";
// Order of alerts, most needed first: open errors, open warnings, acknowledged alerts; the newest
// of each first. AlertBook uses the same order.
constexpr const char* kNeededFirst =
    "who IS NULL DESC, (who IS NULL AND level = 'error') DESC, number DESC";
// SQL condition for an audit entry that was_refused().
constexpr const char* kIsRefusal = "(status BETWEEN 400 AND 499)";

std::int64_t as_stored(std::uint64_t number) { return static_cast<std::int64_t>(number); }
std::uint64_t as_number(std::int64_t stored) { return static_cast<std::uint64_t>(stored); }

}  // namespace

JobTables::JobTables(const std::filesystem::path& file, const std::string& vfs)
    : database_(opened(file, vfs)),
      see_(database_.prepare(
          "INSERT INTO job(number, id, state, has_ended, may_have_moved, submitted_ms, ended_ms, "
          "arms, view) VALUES(?1, ?2, ?3, ?4, 0, ?5, ?6, ?7, ?8) ON CONFLICT(number) DO UPDATE SET "
          "id = ?2, state = ?3, has_ended = ?4, submitted_ms = ?5, ended_ms = ?6, arms = ?7, "
          "view = ?8")),
      end_(database_.prepare("INSERT OR IGNORE INTO temp.ended_now VALUES(?1, ?2)")),
      expect_(database_.prepare(
          "INSERT INTO job(number, id, state, has_ended, may_have_moved, arms, view) "
          "VALUES(?1, '', '', 0, 0, '[]', '') ON CONFLICT(number) DO NOTHING")),
      move_(database_.prepare("UPDATE job SET may_have_moved = 1 WHERE number = ?1")),
      come_(database_.prepare(
          "UPDATE job SET digest = ?2, request_key = nullif(?3, ''), request_digest = ?4, "
          "request_place = ?5 WHERE number = ?1")),
      seal_(database_.prepare(std::string("UPDATE job SET sum = ") + kSumOfJob +
                              " WHERE number = ?1")),
      put_body_(database_.prepare("INSERT OR REPLACE INTO body(number, text) VALUES(?1, ?2)")),
      amend_(database_.prepare("UPDATE body SET amended = ?2 WHERE number = ?1")),
      drop_body_(database_.prepare("DELETE FROM body WHERE number = ?1")),
      seal_body_(database_.prepare(std::string("UPDATE body SET sum = ") + kSumOfBody +
                                   " WHERE number = ?1")),
      stop_(database_.prepare("INSERT OR IGNORE INTO stopped_arm(name) VALUES(?1)")),
      seal_stops_(database_.prepare(std::string("UPDATE stopped_arm SET sum = ") + kSumOfStop)),
      forget_stops_(database_.prepare("DELETE FROM stopped_arm")),
      set_object_(database_.prepare("INSERT INTO scene_object(name, text) VALUES(?1, ?2) ON "
                                    "CONFLICT(name) DO UPDATE SET text = ?2")),
      seal_object_(database_.prepare(std::string("UPDATE scene_object SET sum = ") + kSumOfObject +
                                     " WHERE name = ?1")),
      forget_object_(database_.prepare("DELETE FROM scene_object WHERE name = ?1")),
      set_speed_(
          database_.prepare("INSERT OR REPLACE INTO speed_override(arm, text) VALUES(?1, ?2)")),
      seal_speed_(database_.prepare(std::string("UPDATE speed_override SET sum = ") + kSumOfSpeed +
                                    " WHERE arm = ?1")),
      forget_speed_(database_.prepare("DELETE FROM speed_override WHERE arm = ?1")),
      note_(database_.prepare("INSERT INTO audit(at_ms, who, peer, method, path, status) "
                              "VALUES(?1, ?2, ?3, ?4, ?5, ?6)")),
      seal_note_(database_.prepare(std::string("UPDATE audit SET sum = ") + kSumOfAudit +
                                   " WHERE number = last_insert_rowid()")),
      keep_alert_(database_.prepare(
          "INSERT INTO alert(id, at_ms, level, text, who, acknowledged_ms) VALUES(?1, ?2, ?3, ?4, "
          "nullif(?5, ''), ?6) ON CONFLICT(id) DO UPDATE SET at_ms = ?2, level = ?3, text = ?4, "
          "who = nullif(?5, ''), acknowledged_ms = ?6")),
      seal_alert_(database_.prepare(std::string("UPDATE alert SET sum = ") + kSumOfAlert +
                                    " WHERE id = ?1")),
      answer_(database_.prepare("INSERT OR IGNORE INTO request(key, place, digest, job) "
                                "VALUES(?1, ?2, ?3, ?4)")),
      seal_answer_(database_.prepare(std::string("UPDATE request SET sum = ") + kSumOfRequest +
                                     " WHERE key = ?1 AND place = ?2")),
      count_(database_.prepare("UPDATE written SET commits = ?1")),
      commits_(as_number(database_.number("SELECT commits FROM written"))) {
  database_.run("DELETE FROM job WHERE view = ''");  // never acknowledged
  database_.keep_log(false);
}

Leftover JobTables::leftover() const {
  Leftover left;
  left.last_number = as_number(database_.number("SELECT max(number) FROM job"));
  Statement jobs = database_.prepare(
      std::string(
          "SELECT job.number, id, state, submitted_ms, arms, view, may_have_moved, body.text, "
          "body.amended, job.sum IS NOT ") +
      kSumOfJob + " OR iif(body.number IS NULL, digest IS NOT NULL, body.sum IS NOT " + kSumOfBody +
      ") FROM job LEFT JOIN body USING(number) WHERE "
      "has_ended = 0 ORDER BY job.number");
  while (jobs.step()) {
    LeftJob& found = left.jobs.emplace_back();
    found.job = {.number = as_number(jobs.number(0)),
                 .id = jobs.text(1),
                 .state = jobs.text(2),
                 .submitted_ms = jobs.maybe_number(3),
                 .arms = jobs.text(4),
                 .view = jobs.text(5)};
    found.may_have_moved = jobs.number(6) != 0;
    if (!jobs.is_null(7)) found.body = jobs.text(7);
    if (!jobs.is_null(8)) found.amended = jobs.text(8);
    found.is_damaged = jobs.number(9) != 0;
  }
  left.lost_jobs = static_cast<std::size_t>(database_.number(kLostJobs));
  Statement arms = database_.prepare(std::string("SELECT name, sum IS NOT ") + kSumOfStop +
                                     " FROM stopped_arm ORDER BY name");
  while (arms.step()) {
    if (arms.number(1) != 0) {
      left.stops_are_damaged = true;
    } else {
      left.stopped_arms.push_back(arms.text(0));
    }
  }
  Statement objects = database_.prepare(std::string("SELECT name, text, sum IS NOT ") +
                                        kSumOfObject + " FROM scene_object ORDER BY number");
  while (objects.step()) {
    LeftObject& found = left.objects.emplace_back();
    found.object.name = objects.text(0);
    if (!objects.is_null(1)) found.object.text = objects.text(1);
    found.is_damaged = objects.number(2) != 0;
  }
  Statement speeds = database_.prepare(std::string("SELECT arm, text, sum IS NOT ") + kSumOfSpeed +
                                       " FROM speed_override");
  while (speeds.step()) {
    left.speeds.push_back({{speeds.text(0), speeds.text(1)}, speeds.number(2) != 0});
  }
  Statement alerts = database_.prepare(
      std::string("SELECT id, at_ms, level, text, who, acknowledged_ms FROM (SELECT * FROM alert "
                  "WHERE sum IS ") +
      kSumOfAlert + " ORDER BY " + kNeededFirst + " LIMIT ?1) ORDER BY number");
  alerts.bind_all(std::int64_t{kAlertsKept});
  while (alerts.step()) {
    left.alerts.push_back({alerts.text(0), alerts.number(1), alerts.text(2), alerts.text(3)});
    StoredAlert& alert = left.alerts.back();
    if (!alerts.is_null(4)) alert.acknowledged = {alerts.text(4), alerts.number(5)};
  }
  return left;
}

void JobTables::leave_log() { database_.keep_log(true); }

void JobTables::write(const Pending& changes, std::chrono::milliseconds now) {
  Transaction transaction(database_);
  for (const auto& [number, change] : changes.jobs) write(number, change, now);
  if (changes.stops) {
    forget_stops_.run();
    for (const std::string& name : changes.stops->arms)
      stop_.bind_all(std::string_view(name)).run();
    seal_stops_.run();
  }
  for (const AuditEntry& entry : changes.audit.entries()) {
    note_.bind_all(entry.at_ms, std::string_view(entry.who), std::string_view(entry.peer),
                   std::string_view(entry.method), std::string_view(entry.path),
                   std::int64_t{entry.status});
    note_.run();
    seal_note_.run();
  }
  for (const StoredAlert& alert : changes.alerts) write(alert);
  for (const auto& [name, object] : changes.objects) write(object);
  for (const auto& [arm, speed] : changes.speeds) write(speed);
  for (const auto& [job, request] : changes.answers) {
    const std::string_view key = request.key;
    const auto place = static_cast<std::int64_t>(request.place);
    answer_.bind_all(key, place, std::string_view(request.key_digest), as_stored(job)).run();
    seal_answer_.bind_all(key, place).run();
  }
  const std::uint64_t commits = commits_ + 1;
  count_.bind_all(as_stored(commits)).run();
  transaction.commit();
  commits_ = commits;
}

void JobTables::write(const StoredAlert& alert) {
  const auto& seen = alert.acknowledged;
  const std::string_view who = seen ? std::string_view(seen->who) : "";
  const auto when = seen ? std::optional(seen->at_ms) : std::nullopt;
  keep_alert_.bind_all(std::string_view(alert.id), alert.at_ms, std::string_view(alert.level),
                       std::string_view(alert.text), who, when);
  keep_alert_.run();
  seal_alert_.bind_all(std::string_view(alert.id)).run();
}

void JobTables::write(const StoredObject& object) {
  const std::string_view name = object.name;
  if (!object.text && !object.is_of_cell) return forget_object_.bind_all(name).run();
  set_object_.bind_all(name,
                       object.text ? std::optional(std::string_view(*object.text)) : std::nullopt);
  set_object_.run();
  seal_object_.bind_all(name).run();
}

void JobTables::write(const StoredSpeed& speed) {
  const std::string_view arm = speed.arm;
  if (!speed.text) return forget_speed_.bind_all(arm).run();
  set_speed_.bind_all(arm, std::string_view(*speed.text)).run();
  seal_speed_.bind_all(arm).run();
}

void JobTables::write(std::uint64_t number, const JobChange& change,
                      std::chrono::milliseconds now) {
  const std::int64_t key = as_stored(number);
  if (const auto& job = change.seen) {
    see_.bind_all(key, std::string_view(job->id), std::string_view(job->state),
                  std::int64_t{job->has_ended}, job->submitted_ms, job->ended_ms,
                  std::string_view(job->arms), std::string_view(job->view));
    see_.run();
  } else {
    expect_.bind_all(key).run();
  }
  if (const auto& origin = change.origin) {
    come_.bind_all(key, std::string_view(origin->digest), std::string_view(origin->key),
                   std::string_view(origin->key_digest), static_cast<std::int64_t>(origin->place));
    come_.run();
  }
  if (change.may_have_moved) move_.bind_all(key).run();
  seal_.bind_all(key).run();
  const bool has_ended = change.seen && change.seen->has_ended;
  if (has_ended) end_.bind_all(key, std::int64_t{now.count()}).run();
  if (has_ended) return drop_body_.bind_all(key).run();
  if (change.body) put_body_.bind_all(key, std::string_view(*change.body)).run();
  if (change.amended) amend_.bind_all(key, std::string_view(*change.amended)).run();
  if (change.body || change.amended) seal_body_.bind_all(key).run();
}

bool JobTables::clean_up(const Retention& retention, std::chrono::system_clock::time_point began,
                         std::chrono::milliseconds now) {
  using std::chrono::milliseconds;
  std::int64_t deleted = 0;
  Transaction transaction(database_);
  database_.run(kForgetLostJobs);
  const auto remove = [&](const char* which, std::int64_t bound) {
    Statement statement =
        database_.prepare(std::string("DELETE FROM job WHERE number IN (") + which +
                          // keeps the job with the last number, so that no number is reused
                          ") AND number < (SELECT max(number) FROM job)");
    statement.bind_all(bound, kCleanedAtOnce).run();
    deleted = std::max(deleted, database_.number("SELECT changes()"));
  };
  const std::int64_t ended = database_.number("SELECT count(*) FROM job WHERE has_ended = 1");
  const std::int64_t over = ended - static_cast<std::int64_t>(retention.jobs_max);
  if (over > 0) {
    remove("SELECT number FROM job WHERE has_ended = 1 ORDER BY ended_ms LIMIT min(?1, ?2)", over);
  }
  if (retention.age_max) {
    const auto oldest =
        std::chrono::floor<milliseconds>((began + now - *retention.age_max).time_since_epoch());
    remove(
        "SELECT number FROM job WHERE has_ended = 1 AND ended_ms < ?1 AND number NOT IN (SELECT "
        "number FROM temp.ended_now) ORDER BY ended_ms LIMIT ?2",
        oldest.count());
    remove(
        "SELECT number FROM job JOIN temp.ended_now USING(number) WHERE ended_now.at_ms < ?1 LIMIT "
        "?2",
        (now - milliseconds(*retention.age_max)).count());
  }
  database_.run("DELETE FROM temp.ended_now WHERE number NOT IN (SELECT number FROM job)");
  const auto keep_last = [&](const std::string& rows, std::size_t count) {
    Statement statement = database_.prepare(
        "DELETE FROM " + rows.substr(0, rows.find(' ')) + " WHERE number IN (SELECT number FROM " +
        rows + " AND number <= (SELECT number FROM " + rows +
        " ORDER BY number DESC LIMIT 1 OFFSET ?1) ORDER BY number LIMIT ?2)");
    statement.bind_all(static_cast<std::int64_t>(count), kCleanedAtOnce).run();
    deleted = std::max(deleted, database_.number("SELECT changes()"));
  };
  keep_last(std::string("audit WHERE ") + kIsRefusal, retention.audit_max);
  keep_last(std::string("audit WHERE NOT ") + kIsRefusal, retention.audit_max);
  Statement alerts = database_.prepare(std::string("DELETE FROM alert WHERE number IN (SELECT "
                                                   "number FROM alert ORDER BY ") +
                                       kNeededFirst + " LIMIT ?2 OFFSET ?1)");
  alerts.bind_all(static_cast<std::int64_t>(kAlertsKept), kCleanedAtOnce).run();
  deleted = std::max(deleted, database_.number("SELECT changes()"));
  transaction.commit();
  return deleted == kCleanedAtOnce;
}

}  // namespace armloom
