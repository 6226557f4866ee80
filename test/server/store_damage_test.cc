#include <array>
#include <fstream>

#include "server/store/job_history.h"
#include "test/server/store_fixture.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using test::accept;
using test::job;
using test::start;
using test::Store;

TEST_F(Store, KeepsAuditEntriesOfExecutedRequestsOverRefusals) {
  StoreOptions few = options();
  few.retention.audit_max = 5;
  {
    const auto store = open();
    for (int i = 0; i < 8; ++i)
      store->note({.who = "Ada", .path = std::to_string(i), .status = 202});
    for (int i = 0; i < 50; ++i)
      store->note({.path = std::to_string(i), .status = i % 2 ? 401 : 403});
    store->note({.who = "Ada", .path = "8", .status = 503});
    EXPECT_TRUE(store->flush());
  }
  const auto store = open(few);
  const auto history = JobHistory::open(folder_);
  const auto kept = [&] {
    std::vector<std::string> paths;
    const auto entries = (*history)->audit({}, 100).value().entries;
    paths.reserve(entries.size());
    for (const AuditEntry& entry : entries) {
      paths.push_back(entry.who + entry.path);
    }
    return paths;
  };
  const std::vector<std::string> last{"Ada8", "49",   "48",   "47",   "46",
                                      "45",   "Ada7", "Ada6", "Ada5", "Ada4"};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (kept() != last && std::chrono::steady_clock::now() < deadline) {
  }
  EXPECT_EQ(kept(), last);
}

// An empty database file has lost its jobs, but its log may still hold them.
TEST_F(Store, RefusesAnEmptyFileAsCorrupt) {
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 1).get());
  }
  fs::resize_file(file(), 0);
  std::ofstream(file().string() + "-wal") << "what may be jobs";
  EXPECT_NE(why_not().find("it is corrupt: it is empty"), std::string::npos) << why_not();
  EXPECT_EQ(fs::file_size(file()), 0U);
  EXPECT_EQ(fs::file_size(file().string() + "-wal"), 16U);
  fs::remove(file());
  fs::remove(file().string() + "-wal");
  sql("CREATE TABLE t(x); DROP TABLE t");
  EXPECT_NE(why_not().find("it has no tables"), std::string::npos) << why_not();
}

TEST_F(Store, DetectsDamagedJobRows) {
  const auto leave = [&] {
    fs::remove_all(folder_);
    const auto store = open();
    for (std::uint64_t number = 1; number <= 3; ++number) accept(*store, number).get();
    start(*store, 2).get();
    store->see(job(3, "succeeded"));
  };
  const char* damages[] = {"UPDATE job SET may_have_moved = 0 WHERE number = 2",
                           "UPDATE job SET state = 'queueD' WHERE number = 2",
                           "UPDATE job SET arms = '[\"right\"]' WHERE number = 2",
                           "UPDATE job SET view = '{' WHERE number = 2",
                           "UPDATE body SET text = 'bodY of 2' WHERE number = 2"};
  for (const char* damage : damages) {
    leave();
    sql(damage);
    const auto store = open();
    ASSERT_EQ(store->leftover().jobs.size(), 2U) << damage;
    EXPECT_FALSE(store->leftover().jobs[0].is_damaged) << damage;
    EXPECT_TRUE(store->leftover().jobs[1].is_damaged) << damage;
  }
  leave();
  sql("UPDATE job SET has_ended = 1 WHERE number = 1; UPDATE job SET arms = '' WHERE number = 3");
  const auto store = open();
  const auto history = JobHistory::open(folder_);
  EXPECT_EQ((*history)->damage().value().jobs, (std::vector<std::string>{"j1", "j3"}));
  const auto found = (*history)->find("j3");
  ASSERT_FALSE(found) << "neither there as it is, nor unknown, so that it would be run again";
  EXPECT_NE(found.error().front().detail.find("is damaged (wrong checksum)"), std::string::npos);
  std::vector<std::string> ids;
  const auto read =
      (*history)->oldest_first({}, [&](const StoredJob& one) { ids.push_back(one.id); });
  EXPECT_EQ(ids, std::vector<std::string>{"j2"});
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().front().detail.find("2 jobs are damaged"), std::string::npos);
}

TEST_F(Store, DetectsDamagedStops) {
  const auto leave = [&] {
    fs::remove_all(folder_);
    const auto store = open();
    store->stopped({"left", "right"});
    EXPECT_TRUE(store->flush());
  };
  using Names = std::vector<std::string>;
  leave();
  EXPECT_FALSE(open()->leftover().stops_are_damaged);
  EXPECT_EQ(open()->leftover().stopped_arms, (Names{"left", "right"}));
  for (const char* damage : {"UPDATE stopped_arm SET name = 'lefu' WHERE name = 'left'",
                             "UPDATE stopped_arm SET sum = sum + 1 WHERE name = 'left'"}) {
    leave();
    sql(damage);
    const auto store = open();
    EXPECT_TRUE(store->leftover().stops_are_damaged) << damage;
    EXPECT_EQ(store->leftover().stopped_arms, Names{"right"}) << damage;
    store->stopped({"left"});
    EXPECT_TRUE(store->flush());
  }
  EXPECT_FALSE(open()->leftover().stops_are_damaged) << "written anew, it is whole";
  EXPECT_EQ(open()->leftover().stopped_arms, Names{"left"});
}

// SQLite would replay the log into a new database file, although the log belongs to another file.
TEST_F(Store, DoesNotTouchALogWithoutItsFile) {
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 1).get());
  }
  fs::remove(file());
  std::ofstream(file().string() + "-wal") << "what may be jobs";
  EXPECT_NE(why_not().find("it is missing"), std::string::npos) << why_not();
  EXPECT_FALSE(fs::exists(file()));
  EXPECT_EQ(fs::file_size(file().string() + "-wal"), 16U);
}

TEST_F(Store, DetectsJobsWithMissingRows) {
  {
    const auto store = open();
    for (std::uint64_t number = 1; number <= 3; ++number) {
      std::promise<bool> written;
      StoredJob one = job(number);
      one.origin.digest = "d";
      store->accept({{one, "body"}}, [&](bool is_written) { written.set_value(is_written); });
      EXPECT_TRUE(written.get_future().get());
    }
    store->see(job(4));  // not submitted by a client
    EXPECT_TRUE(store->flush());
  }
  sql("DELETE FROM body WHERE number = 1; DELETE FROM job WHERE number = 2");
  {
    const auto store = open();
    ASSERT_EQ(store->leftover().jobs.size(), 3U);
    EXPECT_TRUE(store->leftover().jobs[0].is_damaged);
    EXPECT_FALSE(store->leftover().jobs[1].is_damaged);
    EXPECT_FALSE(store->leftover().jobs[2].is_damaged);
    EXPECT_EQ(store->leftover().lost_jobs, 1U);
  }
}

// The log of a killed server beside a damaged database is the best source for a repair.
TEST_F(Store, DoesNotTouchTheLogOfACorruptFile) {
  const fs::path copy = folder_.string() + "-killed";
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 1).get());
    fs::remove_all(copy);
    fs::copy(folder_, copy, fs::copy_options::recursive);
  }
  fs::remove_all(folder_);
  fs::rename(copy, folder_);
  const auto all_of = [](const fs::path& one) {
    std::ifstream in(one, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const fs::path log = file().string() + "-wal";
  const std::string of_log = all_of(log), sound = all_of(file());
  EXPECT_GT(of_log.size(), 0U);
  std::string not_writable = sound;  // its header names a newer version
  not_writable[18] = '\xff';
  for (const std::string& of_file : {std::string(5000, 'x') + sound.substr(5000), not_writable}) {
    std::ofstream(file(), std::ios::binary) << of_file;
    EXPECT_NE(why_not().find("nothing was changed"), std::string::npos) << why_not();
    EXPECT_EQ(all_of(file()), of_file);
    EXPECT_EQ(all_of(log), of_log);
  }
}

TEST_F(Store, OmitsAndCountsDamagedAlertsAndAuditEntries) {
  {
    const auto store = open();
    for (const char* id : {"s:1", "s:2", "s:3"}) store->keep({id, 1000, "warning", "stopped"});
    store->keep({"s:1", 1000, "warning", "stopped", StoredAlert::Acknowledgement{"Ada", 2000}});
    for (const char* who : {"Ada", "Bob", ""}) store->note({0, 1000, who, "::1", "POST", "/", 202});
    EXPECT_TRUE(store->flush());
  }
  const auto found = [&] {
    const auto store = open();
    const auto history = JobHistory::open(folder_);
    const auto damage = (*history)->damage().value();
    const auto audit = (*history)->audit({.who = "Bob"}, 100).value();
    EXPECT_EQ(audit.damaged, damage.audit);
    return std::array{store->leftover().alerts.size(), damage.alerts, audit.entries.size(),
                      damage.audit};
  };
  EXPECT_EQ(found(), (std::array<std::size_t, 4>{3, 0, 1, 0}));
  sql("UPDATE alert SET text = 'all is well' WHERE id = 's:2'");
  EXPECT_EQ(found(), (std::array<std::size_t, 4>{2, 1, 1, 0}));
  sql("UPDATE alert SET acknowledged_ms = 1 WHERE id = 's:1'");
  EXPECT_EQ(found(), (std::array<std::size_t, 4>{1, 2, 1, 0}));
  sql("UPDATE audit SET who = 'Eve' WHERE who = 'Bob'; UPDATE audit SET at_ms = 9 WHERE who = ''");
  EXPECT_EQ(found(), (std::array<std::size_t, 4>{1, 2, 0, 2}));
}

}  // namespace
}  // namespace armloom
