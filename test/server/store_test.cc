#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>

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

TEST_F(Store, RestoresUnfinishedJobsInOrder) {
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

TEST_F(Store, SharesOneSyncAmongConcurrentWrites) {
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

TEST_F(Store, RefusesAFolderInUse) {
  const auto store = open();
  EXPECT_NE(why_not().find("is in use by process " + std::to_string(getpid())), std::string::npos);
}

TEST_F(Store, DoesNotTouchForeignOrNewerFiles) {
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
  sql("PRAGMA user_version = -5");
  holds("it is corrupt: tables of version -5");
}

TEST_F(Store, ReportsACorruptFileWithoutRepair) {
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
  EXPECT_NE(why.find("restore a copy"), std::string::npos) << why;
  EXPECT_EQ(fs::file_size(file()), size);
}

// With a mismatched index, jobs would be listed in the index's order, or not at all.
TEST_F(Store, ReportsAMismatchedIndexAsCorrupt) {
  {
    const auto store = open();
    for (std::uint64_t number = 1; number <= 3; ++number) accept(*store, number).get();
  }
  EXPECT_EQ(why_not(), "");
  sql("PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = "
      "'CREATE INDEX job_left ON job(number) WHERE has_ended = 1' WHERE name = 'job_left'");
  EXPECT_NE(why_not().find("it is corrupt: "), std::string::npos) << why_not();
}

TEST_F(Store, CreatesItsTablesAtomically) {
  fs::create_directories(folder_);
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 4).get());
  }
  const std::uint64_t operations = FailingDisk::operations();
  fs::remove_all(folder_);
  // A process that ends at any point while it creates the tables leaves a usable folder.
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

TEST_F(Store, KeepsErrorsAndUnacknowledgedAlertsLongest) {
  const auto alert = [](std::size_t number, const char* level) {
    return StoredAlert{.id = "s:" + std::to_string(number), .level = level, .text = "x"};
  };
  const std::size_t told = kAlertsKept + 500;
  {
    const auto store = open();
    store->keep(alert(0, "error"));
    for (std::size_t i = 1; i < told; ++i) store->keep(alert(i, "warning"));
    StoredAlert seen = alert(told, "error");
    seen.acknowledged = {"Ada", 1};
    store->keep(std::move(seen));
  }
  const auto left = open()->leftover().alerts;
  ASSERT_EQ(left.size(), kAlertsKept);
  EXPECT_EQ(left.front().id, "s:0");
  EXPECT_EQ(left.back().id, "s:" + std::to_string(told - 1));
}

TEST_F(Store, DeletesOldEndedJobs) {
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

// The age of jobs that end in a session is counted by a clock that only goes forward, whatever wall
// time they have: here 1970, because the machine's clock was not set yet.
TEST_F(Store, AgesJobsOfTheSessionByAForwardClock) {
  using namespace std::chrono_literals;
  const auto kept = [&] {
    std::vector<std::uint64_t> numbers;
    EXPECT_TRUE((*JobHistory::open(folder_))->oldest_first({}, [&](const StoredJob& found) {
      numbers.push_back(found.number);
    }));
    return numbers;
  };
  const auto wait_until = [&](const std::vector<std::uint64_t>& numbers) {
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (kept() != numbers && std::chrono::steady_clock::now() < deadline) {
    }
    EXPECT_EQ(kept(), numbers);
  };
  std::atomic<std::chrono::minutes> passed{0min};
  StoreOptions month = options();
  month.retention.age_max = 30 * 24h;
  month.now = [&passed] { return std::chrono::steady_clock::time_point{} + 1h + passed.load(); };
  {
    const auto store = open();
    accept(*store, 1).get();
    store->see(job(1, "succeeded"));  // of an earlier session, in 1970: too old
    accept(*store, 2).get();          // waits over the restart
  }
  const auto store = open(month);
  wait_until({2});
  accept(*store, 3).get();
  accept(*store, 4).get();  // the last number is always kept
  store->see(job(2, "succeeded"));
  store->see(job(3, "succeeded"));
  ASSERT_TRUE(store->flush());
  const auto clean_up_after = [&](std::chrono::minutes time) {
    passed = time;
    accept(*store, 4).get();  // wakes the store's thread, which then cleans up
    ASSERT_TRUE(store->flush());
    accept(*store, 4).get();
  };
  clean_up_after(24h);
  EXPECT_EQ(kept(), (std::vector<std::uint64_t>{2, 3, 4}));
  clean_up_after(31 * 24h);
  wait_until({4});
}

TEST_F(Store, ReusesNoNumberAfterDeletingAllEndedJobs) {
  StoreOptions none = options();
  none.retention.jobs_max = 0;
  {
    const auto store = open();
    for (std::uint64_t number = 1; number <= 5; ++number) {
      accept(*store, number).get();
      store->see(job(number, "succeeded"));
    }
  }
  const auto count = [&] {
    std::size_t jobs = 0;
    EXPECT_TRUE((*JobHistory::open(folder_))->oldest_first({}, [&](const StoredJob&) { ++jobs; }));
    return jobs;
  };
  {
    const auto store = open(none);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (count() > 1 && std::chrono::steady_clock::now() < deadline) {
    }
    EXPECT_TRUE(store->flush());
  }
  EXPECT_EQ(count(), 1U);
  EXPECT_EQ(open()->leftover().last_number, 5U);
}

// As on a read-only medium, or in another user's folder.
TEST_F(Store, ReadsHistoryFromAReadOnlyFolder) {
  { EXPECT_TRUE(accept(*open(), 1).get()); }
  std::filesystem::permissions(folder_, std::filesystem::perms{0555});
  const bool is_root = geteuid() == 0;  // root may write nevertheless
  if (is_root) {
    ASSERT_EQ(setresuid(65534, 65534, 0), 0);
  }
  {
    const auto history = JobHistory::open(folder_);
    EXPECT_TRUE(history.has_value()) << history.error().front().detail;
    if (history) {
      EXPECT_EQ((*history)->find("j1").value()->state, "queued");
    }
  }
  if (is_root) {
    ASSERT_EQ(setresuid(0, 0, 0), 0);
  }
  std::filesystem::permissions(folder_, std::filesystem::perms{0755});
}

TEST_F(Store, RefusesTablesOfAnOlderVersionAndLeavesThemUnchanged) {
  { EXPECT_TRUE(accept(*open(), 1).get()); }
  sql("PRAGMA user_version = 10");
  const auto read = [&] {
    std::ifstream in(file(), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string before = read();
  EXPECT_NE(why_not().find("armloom 0.1 (tables of version 10)"), std::string::npos) << why_not();
  EXPECT_NE(why_not().find("give --data a new folder"), std::string::npos) << why_not();
  const auto history = JobHistory::open(folder_);
  ASSERT_FALSE(history);
  EXPECT_NE(history.error().front().detail.find("armloom 0.1"), std::string::npos);
  EXPECT_EQ(read(), before);
}

TEST_F(Store, ExtendsTablesOfAnEarlierVersion) {
  { EXPECT_TRUE(accept(*open(), 1).get()); }
  sql("DROP TABLE speed_override; PRAGMA user_version = 11");
  EXPECT_TRUE(JobHistory::open(folder_)) << "it needs none of the new tables";
  for (const char* speed : {"0.5", "0.2"}) {
    const auto store = open();
    EXPECT_EQ(store->leftover().jobs.size(), 1U);
    store->set_speed({"left", speed}, [](bool is_written) { EXPECT_TRUE(is_written); });
    EXPECT_TRUE(store->flush());
  }
  const auto store = open();
  const auto& speeds = store->leftover().speeds;
  ASSERT_EQ(speeds.size(), 1U);
  EXPECT_EQ(speeds[0].speed.text, "0.2");
  EXPECT_FALSE(speeds[0].is_damaged);
}

TEST_F(Store, FiltersHistoryByStateArmAndPage) {
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

}  // namespace
}  // namespace armloom
