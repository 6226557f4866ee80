// Whether a store holds what the former run had, as the mark beside it tells.
#include <fstream>
#include <functional>

#include "test/server/store_fixture.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using test::accept;
using test::FailingDisk;
using test::Store;

// With a full disk, too: who starts the server anew must not find arms let go.
TEST_F(Store, ThatStopsWereNotWrittenIsKnownToTheNextRunUntilItHasWrittenSome) {
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

// SQLite takes what it cannot read of a log for the end of it.
TEST_F(Store, AStoreThatHoldsLessThanWasWrittenIsKnown) {
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

// Then it is not known whether there was more, as of a copy of the database alone.
TEST_F(Store, AStoreWithoutItsMarkIsNotTakenForWhole) {
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

// All that a young folder has may be in the log.
TEST_F(Store, ANewFolderOfWhichLogAndMarkAreGoneIsNotTakenForNew) {
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
