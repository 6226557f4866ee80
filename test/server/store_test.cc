// Jobs on disk: what was said to be written is there, whenever and however it ends.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>

#include "server/store/job_history.h"
#include "server/store/job_store.h"
#include "test/server/failing_disk.h"

namespace armloom {
namespace {

using test::FailingDisk;
namespace fs = std::filesystem;

StoredJob job(std::uint64_t number, const std::string& state = "queued") {
  const std::string id = "j" + std::to_string(number);
  return {.number = number,
          .id = id,
          .state = state,
          .has_ended = state == "succeeded",
          .submitted_ms = static_cast<std::int64_t>(number),
          .ended_ms = state == "succeeded" ? std::optional<std::int64_t>(number) : std::nullopt,
          .arms = R"(["left"])",
          .view = R"({"id":")" + id + R"(","state":")" + state + "\"}"};
}

class Store : public ::testing::Test {
 protected:
  void SetUp() override {
    FailingDisk::reset();
    folder_ = fs::path(::testing::TempDir()) / "armloom-store" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
  }
  void TearDown() override { FailingDisk::reset(); }

  StoreOptions options() const {
    StoreOptions options;
    options.retry = std::chrono::milliseconds(5);
    options.vfs = FailingDisk::name();
    return options;
  }
  std::unique_ptr<JobStore> open(const StoreOptions& options) const {
    auto store = JobStore::open(folder_, options);
    if (!store) throw std::runtime_error(store.error().front().detail);
    return std::move(*store);
  }
  std::unique_ptr<JobStore> open() const { return open(options()); }
  std::string why_not() const {
    const auto store = JobStore::open(folder_, options());
    return store ? "" : store.error().front().detail;
  }
  fs::path file() const { return folder_ / "armloom.db"; }
  void sql(const std::string& text) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file().c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }

  fs::path folder_;
};

std::future<bool> accept(JobStore& store, std::uint64_t number) {
  auto promise = std::make_shared<std::promise<bool>>();
  store.accept({{job(number), "body of " + std::to_string(number)}},
               [promise](bool is_written) { promise->set_value(is_written); });
  return promise->get_future();
}
std::future<bool> start(JobStore& store, std::uint64_t number) {
  auto promise = std::make_shared<std::promise<bool>>();
  store.about_to_move(number, [promise](bool is_written) { promise->set_value(is_written); });
  return promise->get_future();
}

TEST_F(Store, WhatHadNotEndedIsThereAgainInItsOrder) {
  {
    const auto store = open();
    EXPECT_TRUE(store->leftover().jobs.empty());
    for (std::uint64_t number : {5, 3, 9}) EXPECT_TRUE(accept(*store, number).get());
    store->see(job(3, "backlogged"));
    store->see(job(9, "running"));
    EXPECT_TRUE(start(*store, 9).get());
    EXPECT_TRUE(accept(*store, 10).get());
    store->see(job(10, "succeeded"));
    store->stopped({"left"});
  }
  const auto store = open();
  const Leftover& left = store->leftover();
  ASSERT_EQ(left.jobs.size(), 3U);
  EXPECT_EQ(left.last_number, 10U);
  EXPECT_EQ(left.stopped_arms, std::vector<std::string>{"left"});
  EXPECT_EQ(left.jobs[0].job.id, "j3");
  EXPECT_EQ(left.jobs[0].job.state, "backlogged");
  EXPECT_EQ(left.jobs[0].body, "body of 3");
  EXPECT_FALSE(left.jobs[0].may_have_moved);
  EXPECT_EQ(left.jobs[1].job.id, "j5");
  EXPECT_EQ(left.jobs[2].job.id, "j9");
  EXPECT_TRUE(left.jobs[2].may_have_moved);
}

TEST_F(Store, ManyThatWaitShareOneSync) {
  const auto store = open();
  EXPECT_TRUE(accept(*store, 1).get());
  std::promise<void> go_on;
  FailingDisk::instead_of(FailingDisk::operations() + 1,
                          [waits = go_on.get_future().share()] { waits.wait(); });
  std::vector<std::future<bool>> answers;
  answers.push_back(accept(*store, 2));
  for (std::uint64_t number = 3; number <= 200; ++number) answers.push_back(accept(*store, number));
  go_on.set_value();
  for (auto& answer : answers) EXPECT_TRUE(answer.get());
  EXPECT_LE(FailingDisk::syncs(), 60U) << "200 jobs, and the making of the tables";
  const std::uint64_t before = FailingDisk::syncs();
  EXPECT_TRUE(accept(*store, 201).get());
  EXPECT_EQ(FailingDisk::syncs(), before + 1) << "one that is alone costs one";
}

TEST_F(Store, OneServerForEachFolder) {
  const auto store = open();
  EXPECT_NE(why_not().find("is in use by process " + std::to_string(getpid())), std::string::npos);
}

TEST_F(Store, WhatIsNotOursOrNotWholeIsLeftAsItIs) {
  const auto holds = [&](const std::string& text) {
    const std::string why = why_not();
    EXPECT_NE(why.find(text), std::string::npos) << why;
    EXPECT_NE(why.find(file().string()), std::string::npos) << why;
  };
  fs::create_directories(folder_);
  std::ofstream(file())
      << "this is no database, but some text that is long enough for a header....";
  holds("not a database");
  EXPECT_EQ(fs::file_size(file()), 71U);
  fs::remove(file());
  sql("CREATE TABLE theirs(x)");
  holds("another program's");
  fs::remove(file());
  { const auto store = open(); }
  sql("PRAGMA user_version = 99");
  holds("newer version of armloom (tables of version 99");
}

TEST_F(Store, ACorruptFileIsSaidToBeAndNotMended) {
  {
    const auto store = open();
    for (std::uint64_t number = 1; number <= 200; ++number) accept(*store, number).get();
  }
  const auto size = fs::file_size(file());
  {
    std::fstream damage(file(), std::ios::in | std::ios::out | std::ios::binary);
    damage.seekp(static_cast<std::streamoff>(size / 2));
    damage << std::string(4096, '\x5a');
  }
  const std::string why = why_not();
  EXPECT_NE(why.find("put back a copy"), std::string::npos) << why;
  EXPECT_EQ(fs::file_size(file()), size);
}

// Of an old version: its jobs are kept.
TEST_F(Store, TablesAreBroughtUpToDateWhole) {
  fs::create_directories(folder_);
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 4).get());
  }
  const std::uint64_t operations = FailingDisk::operations();
  fs::remove_all(folder_);
  // A process that ends anywhere in the making of the tables leaves what can be opened.
  for (std::uint64_t nth = 1; nth < operations; ++nth) {
    fs::remove_all(folder_);
    const pid_t child = fork();
    if (child == 0) {
      FailingDisk::reset();
      FailingDisk::instead_of(nth, [] { _exit(0); });
      (void)JobStore::open(folder_, options());
      _exit(0);
    }
    waitpid(child, nullptr, 0);
    ASSERT_EQ(why_not(), "") << "ended at operation " << nth;
  }
}

TEST_F(Store, OldJobsThatHaveEndedAreDeleted) {
  StoreOptions few = options();
  few.retention.jobs_max = 10;
  {
    const auto store = open();
    for (std::uint64_t number = 1; number <= 50; ++number) {
      accept(*store, number).get();
      if (number != 7) store->see(job(number, "succeeded"));
    }
  }
  const auto store = open(few);
  EXPECT_EQ(store->leftover().last_number, 50U);
  ASSERT_EQ(store->leftover().jobs.size(), 1U);
  const auto history = JobHistory::open(folder_);
  const auto numbers = [&] {
    std::vector<std::uint64_t> kept;
    EXPECT_TRUE((*history)->oldest_first(
        {}, [&](const StoredJob& found) { kept.push_back(found.number); }));
    return kept;
  };
  const std::vector<std::uint64_t> last{7, 41, 42, 43, 44, 45, 46, 47, 48, 49, 50};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (numbers() != last && std::chrono::steady_clock::now() < deadline) {
  }
  EXPECT_EQ(numbers(), last) << "one that waits is never deleted";
}

TEST_F(Store, HistoryIsReadByStateArmAndPage) {
  const auto store = open();
  for (std::uint64_t number = 1; number <= 30; ++number) {
    accept(*store, number).get();
    StoredJob seen = job(number, number % 2 == 0 ? "succeeded" : "failed");
    if (number % 3 == 0) seen.arms = R"(["left","right"])";
    store->see(seen);
  }
  ASSERT_TRUE(store->flush());
  const auto history = JobHistory::open(folder_);
  ASSERT_TRUE(history);
  std::vector<std::uint64_t> found;
  ASSERT_TRUE((*history)->newest_first({.state = "succeeded", .arm = "right", .before = 30},
                                       [&](const StoredJob& seen) {
                                         found.push_back(seen.number);
                                         return found.size() < 3;
                                       }));
  EXPECT_EQ(found, (std::vector<std::uint64_t>{24, 18, 12}));
  EXPECT_EQ((*history)->find("j24").value()->state, "succeeded");
  EXPECT_FALSE((*history)->find("none").value());
}

// ---- A disk that fails ----

TEST_F(Store, AFullDiskIsSaidAndWhatWaitsIsWrittenWhenThereIsSpace) {
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

// What a client and the executive do to ten jobs; `acknowledged` is told what they may rely on.
void live(JobStore& store, const std::function<void(const std::string&)>& acknowledged) {
  for (std::uint64_t number = 1; number <= 10; ++number) {
    if (!accept(store, number).get()) continue;
    acknowledged("a" + std::to_string(number));
    if (number % 2 == 0) continue;
    if (!start(store, number).get()) continue;
    acknowledged("m" + std::to_string(number));
    store.see(job(number, "running"));
    if (number % 3 != 0) continue;
    store.see(job(number, "succeeded"));
    if (store.flush()) acknowledged("e" + std::to_string(number));
  }
}

// Whatever was acknowledged is there, once; nothing that may have moved can be run again.
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
  for (std::string what; lines >> what;) {
    const std::uint64_t number = std::stoull(what.substr(1));
    const auto found = (*history)->find("j" + std::to_string(number)).value();
    ASSERT_TRUE(found) << when << ": job " << number << " is lost";
    EXPECT_TRUE(what[0] != 'e' || found->has_ended) << when << ": " << what;
    if (found->has_ended) continue;
    ASSERT_TRUE(left.contains(number)) << when;
    EXPECT_EQ(left[number].body, "body of " + std::to_string(number)) << when;
    EXPECT_TRUE(what[0] != 'm' || left[number].may_have_moved) << when << ": " << what;
  }
}

class Cut : public Store, public ::testing::WithParamInterface<const char*> {};

// The process ends at its Nth write, or the power does: for every N.
TEST_P(Cut, LosesNothingThatWasAcknowledgedWhereverItComes) {
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
    if (is_power) fs::remove(file().string() + "-shm");  // it is memory
    std::ifstream in(said);
    const std::string acknowledged{std::istreambuf_iterator<char>(in), {}};
    expect_kept(folder_, acknowledged, "cut at operation " + std::to_string(nth));
    if (HasFatalFailure() || WEXITSTATUS(status) == 0) break;
    ++cuts;
  }
  EXPECT_GT(cuts, 50U);
}
INSTANTIATE_TEST_SUITE_P(Store, Cut, ::testing::Values("process", "power"));

// The Nth write fails, or that and some after it: for every N.
TEST_F(Store, NoWriteThatFailsLosesWhatWasAcknowledged) {
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
