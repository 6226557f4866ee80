// The mark (high-water mark) detects that the store beside it lacks records.
#include <fstream>
#include <functional>

#include "test/server/store_fixture.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using test::accept;
using test::FailingDisk;
using test::Store;

TEST_F(Store, ReportsUnwrittenStopsUntilStopsAreWritten) {
  {
    const auto store = open();
    store->stopped({"left"});
    EXPECT_TRUE(store->flush());
    FailingDisk::fail(FailingDisk::Fault::full, 0);
    store->stopped({"left", "right"});
  }
  FailingDisk::fail(FailingDisk::Fault::none, 0);
  EXPECT_TRUE(open()->leftover().stops_are_unwritten);
  EXPECT_EQ(open()->leftover().stopped_arms, std::vector<std::string>{"left"});
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 1).get());
    EXPECT_TRUE(store->leftover().stops_are_unwritten);
  }
  {
    const auto store = open();
    EXPECT_TRUE(store->leftover().stops_are_unwritten) << "nobody has seen to it yet";
    store->stopped({});
    EXPECT_TRUE(store->flush());
  }
  EXPECT_FALSE(open()->leftover().stops_are_unwritten);
}

// SQLite takes an unreadable part of a log for the end of the log.
TEST_F(Store, DetectsLostCommits) {
  const fs::path killed = folder_.string() + "-killed", older = folder_.string() + "-older";
  fs::remove_all(killed);
  fs::remove_all(older);
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 1).get());
  }
  fs::copy(folder_, older, fs::copy_options::recursive);
  {
    const auto store = open();
    for (const std::uint64_t number : {2U, 3U, 4U}) EXPECT_TRUE(accept(*store, number).get());
    EXPECT_TRUE(store->flush());
    fs::copy(folder_, killed, fs::copy_options::recursive);
  }
  const fs::path log = file().string() + "-wal";
  const auto found = [&](const std::function<void()>& damage) {
    fs::remove_all(folder_);
    fs::copy(killed, folder_, fs::copy_options::recursive);
    damage();
    return open()->leftover();
  };
  EXPECT_FALSE(found([] {}).is_behind);
  const std::function<void()> damages[] = {
      [&] { fs::remove(log); }, [&] { fs::resize_file(log, fs::file_size(log) / 2); },
      [&] { std::fstream(log, std::ios::in | std::ios::out) << "xxxx"; },
      [&] {
        fs::remove(log);
        fs::copy(older / "armloom.db", file(), fs::copy_options::overwrite_existing);
      },
      [&] {
        fs::remove(log);
        fs::remove(file());
      }};
  for (const auto& damage : damages) {
    SCOPED_TRACE(&damage - damages);
    const Leftover left = found(damage);
    EXPECT_TRUE(left.is_behind);
    EXPECT_LT(left.jobs.size(), 4U);
    {
      const auto store = open();
      EXPECT_TRUE(store->leftover().is_behind) << "until something is written";
      EXPECT_TRUE(accept(*store, 9).get());
    }
    EXPECT_FALSE(open()->leftover().is_behind);
    EXPECT_TRUE(open()->leftover().stops_are_unwritten) << "until they are written";
  }
}

// Without the mark, for example in a copy of the database alone, lost records cannot be excluded.
TEST_F(Store, DetectsAMissingOrDamagedMark) {
  const auto leave = [&] {
    fs::remove_all(folder_);
    const auto store = open();
    EXPECT_FALSE(store->leftover().is_unmarked) << "a new one has none yet";
    EXPECT_TRUE(accept(*store, 1).get());
  };
  const fs::path mark = folder_ / "armloom.mark";
  const std::string zeros(33, '\0'), half = "00000000000000000099";
  const std::function<void()> damages[] = {
      [&] { fs::remove(mark); }, [&] { std::ofstream(mark).flush(); },
      [&] { std::ofstream(mark) << zeros; }, [&] { std::ofstream(mark) << half; }};
  for (const auto& damage : damages) {
    SCOPED_TRACE(&damage - damages);
    leave();
    damage();
    EXPECT_TRUE(open()->leftover().is_unmarked);
    {
      const auto store = open();
      EXPECT_FALSE(store->leftover().is_unmarked) << "told once";
      EXPECT_TRUE(store->leftover().stops_are_unwritten) << "until they are written";
      store->stopped({"left"});
      EXPECT_TRUE(store->flush());
    }
    EXPECT_FALSE(open()->leftover().stops_are_unwritten);
  }
}

// The records of a new folder may all be in the log.
TEST_F(Store, DetectsThatANewFolderHasLostItsLogAndMark) {
  const fs::path killed = folder_.string() + "-killed";
  fs::remove_all(killed);
  {
    const auto store = open();
    EXPECT_TRUE(accept(*store, 1).get());
    fs::copy(folder_, killed, fs::copy_options::recursive);
  }
  fs::remove_all(folder_);
  fs::rename(killed, folder_);
  fs::remove(folder_ / "armloom.mark");
  fs::remove(file().string() + "-wal");
  EXPECT_TRUE(open()->leftover().is_unmarked);
}

}  // namespace
}  // namespace armloom
