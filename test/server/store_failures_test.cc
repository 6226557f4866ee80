#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "server/store/job_history.h"
#include "test/server/store_fixture.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using test::accept;
using test::FailingDisk;
using test::job;
using test::start;
using test::Store;

TEST_F(Store, ReportsAFullDiskAndWritesWhenThereIsSpace) {
  std::vector<std::string> told;
  StoreOptions watched = options();
  watched.on_fault = [&](const StoreFault* fault) { told.push_back(fault ? fault->text : "well"); };
  {
    const auto store = open(watched);
    EXPECT_TRUE(accept(*store, 1).get());
    FailingDisk::fail(FailingDisk::Fault::full, 0);
    EXPECT_FALSE(accept(*store, 2).get());
    ASSERT_TRUE(store->fault());
    EXPECT_TRUE(store->fault()->is_full);
    auto started = start(*store, 1);
    store->see(job(1, "running"));
    EXPECT_EQ(started.wait_for(std::chrono::milliseconds(30)), std::future_status::timeout)
        << "nothing moves that is not put down";
    FailingDisk::fail(FailingDisk::Fault::none, 0);
    EXPECT_TRUE(started.get());
    EXPECT_FALSE(store->fault());
  }
  EXPECT_EQ(told.size(), 2U);
  EXPECT_EQ(told.back(), "well");
  const auto store = open();
  ASSERT_EQ(store->leftover().jobs.size(), 1U) << "the one that was refused is not there";
  EXPECT_TRUE(store->leftover().jobs.front().may_have_moved);
}

TEST_F(Store, ReportsARemedyIfItCannotBeOpened) {
  FailingDisk::fail(FailingDisk::Fault::full, 0);
  EXPECT_NE(why_not().find("nothing was changed: make room on the disk"), std::string::npos);
  FailingDisk::fail(FailingDisk::Fault::broken, 0);
  EXPECT_NE(why_not().find("make it readable and writable"), std::string::npos);
  FailingDisk::reset();
  std::ofstream(file()) << "no database, but a text that is long enough for one";
  EXPECT_NE(why_not().find("repair it"), std::string::npos) << why_not();
}

// If the server kept writing, another server could use the folder, or would not find what this
// server writes.
TEST_F(Store, StopsWritingIfItsFilesAreReplaced) {
  for (const char* name : {"armloom.lock", "armloom.db", "armloom.mark", "armloom.db-wal"}) {
    SCOPED_TRACE(name);
    fs::remove_all(folder_);
    std::promise<std::string> told;
    StoreOptions watched = options();
    watched.on_fault = [&](const StoreFault* fault) {
      if (fault != nullptr) told.set_value(fault->text);
    };
    const auto store = open(watched);
    EXPECT_TRUE(accept(*store, 1).get());
    fs::rename(folder_ / name, folder_ / "aside");
    EXPECT_NE(told.get_future().get().find(name), std::string::npos) << "also if nobody asks";
    EXPECT_FALSE(accept(*store, 2).get());
    auto started = start(*store, 1);
    EXPECT_EQ(started.wait_for(std::chrono::milliseconds(30)), std::future_status::timeout);
    fs::rename(folder_ / "aside", folder_ / name);
    EXPECT_TRUE(started.get());
    EXPECT_FALSE(store->fault());
  }
}

// The records in the lost log are gone. The database file must stay intact, and the next session
// must report the loss.
TEST_F(Store, ReportsATruncatedLogAndDoesNotCheckpointIt) {
  const fs::path log = file().string() + "-wal";
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 1).get());
    fs::resize_file(log, 0);
    EXPECT_FALSE(accept(*store, 2).get());
    EXPECT_NE(store->fault()->text.find("armloom.db-wal was truncated"), std::string::npos);
  }
  const auto store = open();
  EXPECT_TRUE(store->leftover().is_behind);
  EXPECT_TRUE(accept(*store, 3).get());
}

TEST_F(Store, NeverWritesARefusedJob) {
  {
    const auto store = open();
    FailingDisk::fail(FailingDisk::Fault::full, 0);
    auto refused = accept(*store, 1);
    store->see(job(1, "backlogged"));
    EXPECT_FALSE(refused.get());
    store->see(job(1, "backlogged"));
    auto started = start(*store, 1);
    store->see(job(1, "succeeded"));
    FailingDisk::fail(FailingDisk::Fault::none, 0);
    EXPECT_TRUE(accept(*store, 2).get());
    EXPECT_THROW(started.get(), std::future_error) << "nobody says that it may begin";
  }
  const auto store = open();
  ASSERT_EQ(store->leftover().jobs.size(), 1U);
  EXPECT_EQ(store->leftover().jobs[0].job.id, "j2");
  EXPECT_FALSE(JobHistory::open(folder_).value()->find("j1").value());
}

TEST_F(Store, KeepsRoomForExecutedRequestsAmongRefusals) {
  const auto store = open();
  FailingDisk::fail(FailingDisk::Fault::full, 0);
  for (int i = 0; i < 10'100; ++i) store->note({.status = 401});
  store->note({.who = "Ada", .status = 202});
  FailingDisk::fail(FailingDisk::Fault::none, 0);
  EXPECT_TRUE(store->flush() || store->flush());
  const auto newest = JobHistory::open(folder_).value()->audit({}, 1).value().entries;
  ASSERT_EQ(newest.size(), 1U);
  EXPECT_EQ(newest[0].who, "Ada");
}

// Performs what a client and the executive do with ten jobs; reports each acknowledgement.
void live(JobStore& store, const std::function<void(const std::string&)>& acknowledged) {
  for (std::uint64_t number = 1; number <= 10; ++number) {
    if (!accept(store, number).get()) continue;
    acknowledged("a" + std::to_string(number));
    store.stopped({"arm-" + std::to_string(number)});
    acknowledged("s" + std::to_string(number));
    if (number % 2 == 0) continue;
    if (!start(store, number).get()) continue;
    acknowledged("m" + std::to_string(number));
    store.see(job(number, "running"));
    if (number % 3 != 0) continue;
    store.see(job(number, "succeeded"));
    if (store.flush()) acknowledged("e" + std::to_string(number));
  }
}

// Expects every acknowledged record once, and that no job that may have moved can run again.
void expect_kept(const fs::path& folder, const std::string& acknowledged, const std::string& when) {
  StoreOptions options;
  options.vfs = FailingDisk::name();
  const auto store = JobStore::open(folder, options);
  ASSERT_TRUE(store) << when << ": " << store.error().front().detail;
  std::map<std::uint64_t, LeftJob> left;
  std::uint64_t before = 0;
  for (const LeftJob& found : (*store)->leftover().jobs) {
    EXPECT_GT(found.job.number, before) << when;
    before = found.job.number;
    left.emplace(before, found);
  }
  const auto history = JobHistory::open(folder);
  std::istringstream lines(acknowledged);
  std::vector<std::string> stop;
  for (std::string what; lines >> what;) {
    const std::uint64_t number = std::stoull(what.substr(1));
    if (what[0] == 's') {
      stop = {"arm-" + std::to_string(number)};
      continue;
    }
    const auto found = (*history)->find("j" + std::to_string(number)).value();
    ASSERT_TRUE(found) << when << ": job " << number << " is lost";
    EXPECT_TRUE(what[0] != 'e' || found->has_ended) << when << ": " << what;
    if (found->has_ended) continue;
    ASSERT_TRUE(left.contains(number)) << when;
    EXPECT_EQ(left[number].body, "body of " + std::to_string(number)) << when;
    EXPECT_TRUE(what[0] != 'm' || left[number].may_have_moved) << when << ": " << what;
  }
  EXPECT_FALSE((*store)->leftover().is_behind) << when;
  EXPECT_TRUE((*store)->leftover().stopped_arms == stop || (*store)->leftover().stops_are_unwritten)
      << when;
}

class Cut : public Store, public ::testing::WithParamInterface<const char*> {};

TEST_P(Cut, LosesNoAcknowledgedRecordAtAnyWrite) {
  const bool is_power = std::string(GetParam()) == "power";
  const fs::path said = folder_.string() + "-said";
  std::uint64_t cuts = 0;
  for (std::uint64_t nth = 1;; ++nth) {
    fs::remove_all(folder_);
    fs::remove(said);
    const pid_t child = fork();
    if (child == 0) {
      FailingDisk::reset();
      FailingDisk::instead_of(nth, [&] {
        if (is_power) FailingDisk::lose_unsynced();
        _exit(1);
      });
      std::ofstream out(said);
      auto store = JobStore::open(folder_, options());
      if (store) live(**store, [&](const std::string& what) { out << what << std::endl; });
      if (store) (*store)->close();
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (is_power) fs::remove(file().string() + "-shm");  // shared memory, lost in a power cut
    std::ifstream in(said);
    const std::string acknowledged{std::istreambuf_iterator<char>(in), {}};
    expect_kept(folder_, acknowledged, "cut at operation " + std::to_string(nth));
    if (HasFatalFailure() || WEXITSTATUS(status) == 0) break;
    ++cuts;
  }
  EXPECT_GT(cuts, 50U);
}
INSTANTIATE_TEST_SUITE_P(Store, Cut, ::testing::Values("process", "power"));

TEST_F(Store, LosesNoAcknowledgedRecordIfAnyWriteFails) {
  std::uint64_t faults = 0;
  for (const auto fault : {FailingDisk::Fault::full, FailingDisk::Fault::broken}) {
    for (std::uint64_t nth = 1;; ++nth) {
      fs::remove_all(folder_);
      FailingDisk::reset();
      FailingDisk::fail(fault, nth, nth + nth % 3);
      std::string acknowledged;
      bool has_failed = true;
      if (auto store = JobStore::open(folder_, options())) {
        live(**store, [&](const std::string& what) { acknowledged += what + "\n"; });
        (*store)->close();
        has_failed = FailingDisk::operations() >= nth;
      }
      FailingDisk::reset();
      expect_kept(folder_, acknowledged, "fault at operation " + std::to_string(nth));
      if (HasFatalFailure() || !has_failed) break;
      ++faults;
    }
  }
  EXPECT_GT(faults, 100U);
}

}  // namespace
}  // namespace armloom
