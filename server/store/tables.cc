#include "server/store/tables.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "server/store/sync_folder.h"

namespace armloom {
namespace {

constexpr int kApplication = 0x41726d6c;  // "Arml"

// Migrations to each version. Never change a released migration; add a new version.
constexpr const char* kVersions[] = {
    // A job as last published (`view`, JSON); `number` is the order of acceptance over all
    // sessions. `may_have_moved` is set before the job moves. `body`, as the client sent it, is
    // needed to run the job and deleted when it has ended.
    R"(
    CREATE TABLE job(
      number INTEGER PRIMARY KEY,
      id TEXT NOT NULL,
      state TEXT NOT NULL,
      has_ended INTEGER NOT NULL,
      may_have_moved INTEGER NOT NULL,
      submitted_ms INTEGER,
      ended_ms INTEGER,
      arms TEXT NOT NULL,
      view TEXT NOT NULL
    ) STRICT;
    CREATE INDEX job_by_id ON job(id);
    CREATE INDEX job_left ON job(number) WHERE has_ended = 0;
    CREATE INDEX job_by_end ON job(ended_ms) WHERE has_ended = 1;
    CREATE TABLE body(number INTEGER PRIMARY KEY, text TEXT NOT NULL) STRICT;
    CREATE TABLE stopped_arm(name TEXT PRIMARY KEY) STRICT;
    )",
    // The request that created a job (RequestOrigin), for repeated requests; the audit trail.
    R"(
    ALTER TABLE job ADD COLUMN digest TEXT;
    ALTER TABLE job ADD COLUMN request_key TEXT;
    ALTER TABLE job ADD COLUMN request_digest TEXT;
    ALTER TABLE job ADD COLUMN request_place INTEGER;
    CREATE INDEX job_by_request ON job(request_key) WHERE request_key IS NOT NULL;
    CREATE TABLE audit(
      number INTEGER PRIMARY KEY,
      at_ms INTEGER NOT NULL,
      who TEXT NOT NULL,
      peer TEXT NOT NULL,
      method TEXT NOT NULL,
      path TEXT NOT NULL,
      status INTEGER NOT NULL
    ) STRICT;
    )",
    // Amendments of a job (JSON), kept as long as the body.
    R"(
    ALTER TABLE body ADD COLUMN amended TEXT;
    )",
    // Alerts and acknowledgements (StoredAlert).
    R"(
    CREATE TABLE alert(
      number INTEGER PRIMARY KEY,
      id TEXT NOT NULL UNIQUE,
      at_ms INTEGER NOT NULL,
      level TEXT NOT NULL,
      text TEXT NOT NULL,
      who TEXT,
      acknowledged_ms INTEGER
    ) STRICT;
    )",
    // Checksums (kSumOfJob, kSumOfBody); NULL in rows of older versions.
    R"(
    ALTER TABLE job ADD COLUMN sum INTEGER;
    ALTER TABLE body ADD COLUMN sum INTEGER;
    )",
    // Checksums (kSumOfAlert, kSumOfAudit).
    R"(
    ALTER TABLE alert ADD COLUMN sum INTEGER;
    ALTER TABLE audit ADD COLUMN sum INTEGER;
    )",
    // Checksum (kSumOfStop).
    R"(
    ALTER TABLE stopped_arm ADD COLUMN sum INTEGER;
    )",
    // Clients' changes of scene objects (StoredObject), in order of arrival.
    R"(
    CREATE TABLE scene_object(
      number INTEGER PRIMARY KEY,
      name TEXT NOT NULL UNIQUE,
      text TEXT,
      sum INTEGER
    ) STRICT;
    )",
    // Number of commits (StoreMark); NULL from an upgrade to the first write.
    R"(
    CREATE TABLE written(commits INTEGER) STRICT;
    INSERT INTO written VALUES(NULL);
    )",
    // Further requests answered with an existing job, known by its id (RequestOrigin).
    R"(
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
    )",
};
constexpr auto kNewest = static_cast<std::int64_t>(std::size(kVersions));

// Applies all migrations or none, so that a file that does not fit its version stays as it is.
void upgrade(Database& database, std::int64_t version) {
  if (version == kNewest) return;
  Transaction transaction(database);
  for (std::int64_t next = version; next < kNewest; ++next) database.run(kVersions[next]);
  database.run("PRAGMA application_id = " + std::to_string(kApplication));
  database.run("PRAGMA user_version = " + std::to_string(kNewest));
  transaction.commit();
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
    upgrade(database, 0);
    database.run("UPDATE written SET commits = 0");
  }
  std::filesystem::rename(unfinished, file);
  sync_folder(file.parent_path());
}

void bring_up_to_date(Database& database) {
  const std::int64_t version = database.number("PRAGMA user_version");
  const std::int64_t application = database.number("PRAGMA application_id");
  if (database.number("SELECT count(*) FROM sqlite_schema") == 0) {
    throw std::runtime_error("it is corrupt: it has no tables");
  }
  if (application != kApplication) throw std::runtime_error("it is another program's database");
  if (version < 1) {
    throw std::runtime_error("it is corrupt: tables of version " + std::to_string(version));
  }
  if (version > kNewest) {
    throw std::runtime_error("it was written by a newer version of armloom (tables of version " +
                             std::to_string(version) + ", this one knows " +
                             std::to_string(kNewest) + ")");
  }
  check_whole(database);
  upgrade(database, version);
}

}  // namespace armloom
