#include "server/store/tables.h"

#include <algorithm>
#include <string>

#include "server/store/sync_folder.h"

namespace armloom {
namespace {

constexpr int kApplication = 0x41726d6c;  // "Arml"

// Tables and columns:
// - job.number: order of acceptance over all sessions
// - job.view: the job as last published (JSON)
// - job.may_have_moved: set before the job moves
// - job.request_*: the request that created the job (RequestOrigin)
// - request: other requests that were answered with the job (RequestOrigin)
// - body: the client's request, which is needed to run the job; deleted when the job has ended
// - body.amended: later changes of the request (JSON)
// - speed_override.arm: '' for the cell; text: JSON, as requested
// - sum: detects damaged rows (kSumOf...)
constexpr const char* kTables = R"(
    CREATE TABLE job(
      number INTEGER PRIMARY KEY,
      id TEXT NOT NULL,
      state TEXT NOT NULL,
      has_ended INTEGER NOT NULL,
      may_have_moved INTEGER NOT NULL,
      submitted_ms INTEGER,
      ended_ms INTEGER,
      arms TEXT NOT NULL,
      view TEXT NOT NULL,
      digest TEXT,
      request_key TEXT,
      request_digest TEXT,
      request_place INTEGER,
      sum INTEGER
    ) STRICT;
    CREATE INDEX job_by_id ON job(id);
    CREATE INDEX job_left ON job(number) WHERE has_ended = 0;
    CREATE INDEX job_by_end ON job(ended_ms) WHERE has_ended = 1;
    CREATE INDEX job_by_request ON job(request_key) WHERE request_key IS NOT NULL;
    CREATE TABLE body(
      number INTEGER PRIMARY KEY,
      text TEXT NOT NULL,
      amended TEXT,
      sum INTEGER
    ) STRICT;
    CREATE TABLE stopped_arm(name TEXT PRIMARY KEY, sum INTEGER) STRICT;
    CREATE TABLE audit(
      number INTEGER PRIMARY KEY,
      at_ms INTEGER NOT NULL,
      who TEXT NOT NULL,
      peer TEXT NOT NULL,
      method TEXT NOT NULL,
      path TEXT NOT NULL,
      status INTEGER NOT NULL,
      sum INTEGER
    ) STRICT;
    CREATE TABLE alert(
      number INTEGER PRIMARY KEY,
      id TEXT NOT NULL UNIQUE,
      at_ms INTEGER NOT NULL,
      level TEXT NOT NULL,
      text TEXT NOT NULL,
      who TEXT,
      acknowledged_ms INTEGER,
      sum INTEGER
    ) STRICT;
    CREATE TABLE scene_object(
      number INTEGER PRIMARY KEY,
      name TEXT NOT NULL UNIQUE,
      text TEXT,
      sum INTEGER
    ) STRICT;
    CREATE TABLE request(
      key TEXT NOT NULL,
      place INTEGER NOT NULL,
      digest TEXT NOT NULL,
      job INTEGER NOT NULL,
      sum INTEGER,
      PRIMARY KEY(key, place)
    ) STRICT;
    CREATE INDEX request_by_job ON request(job);
    CREATE TRIGGER request_goes AFTER DELETE ON job BEGIN
      DELETE FROM request WHERE job = old.number;
    END;
    CREATE TABLE written(commits INTEGER NOT NULL) STRICT;
    INSERT INTO written VALUES(0);
)";

// Since version 12.
constexpr const char* kSpeedTable =
    "CREATE TABLE speed_override(arm TEXT PRIMARY KEY, text TEXT NOT NULL, sum INTEGER) STRICT;";

// Version of the tables. Versions 1 to 10 belong to armloom 0.1.
constexpr std::int64_t kVersion = 12;
constexpr std::int64_t kOldestVersion = 11;  // that upgrade() knows

void set_version(Database& database) {
  database.run("PRAGMA user_version = " + std::to_string(kVersion));
}

void check_whole(const Database& database) {
  std::string found = database.text("PRAGMA integrity_check(1)");
  std::ranges::replace(found, '\n', ' ');
  if (found != "ok") throw std::runtime_error("it is corrupt: " + found);
}

}  // namespace

void make_store(const std::filesystem::path& file, const std::string& vfs) {
  const std::filesystem::path unfinished = file.string() + ".new";
  for (const char* end : {"", "-journal"}) std::filesystem::remove(unfinished.string() + end);
  {
    Database database(unfinished, Database::Access::make, vfs);
    Transaction transaction(database);
    database.run(kTables);
    database.run(kSpeedTable);
    database.run("PRAGMA application_id = " + std::to_string(kApplication));
    set_version(database);
    transaction.commit();
  }
  std::filesystem::rename(unfinished, file);
  sync_folder(file.parent_path());
}

void check_version(const Database& database) {
  const std::int64_t version = database.number("PRAGMA user_version");
  const std::int64_t application = database.number("PRAGMA application_id");
  if (database.number("SELECT count(*) FROM sqlite_schema") == 0) {
    throw std::runtime_error("it is corrupt: it has no tables");
  }
  if (application != kApplication) throw std::runtime_error("it is another program's database");
  const std::string tables = "tables of version " + std::to_string(version);
  if (version < 1) throw std::runtime_error("it is corrupt: " + tables);
  if (version < kOldestVersion) {
    throw std::runtime_error(
        "it was written by armloom 0.1 (" + tables +
        "), whose jobs this version cannot read: give --data a new folder, and "
        "read this one with armloom 0.1");
  }
  if (version > kVersion) {
    throw std::runtime_error("it was written by a newer version of armloom (" + tables +
                             ", this one knows " + std::to_string(kVersion) +
                             "): update armloom, or give --data a new folder");
  }
}

void upgrade(Database& database) {
  if (database.number("PRAGMA user_version") == kVersion) return;
  Transaction transaction(database);
  database.run(kSpeedTable);
  set_version(database);
  transaction.commit();
}

void check_store(const Database& database) {
  check_version(database);
  check_whole(database);
}

}  // namespace armloom
