#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "server/store/job_store.h"
#include "test/server/failing_disk.h"

namespace armloom::test {

inline StoredJob job(std::uint64_t number, const std::string& state = "queued") {
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
    folder_ = std::filesystem::path(::testing::TempDir()) / "armloom-store" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
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
  std::filesystem::path file() const { return folder_ / "armloom.db"; }
  void sql(const std::string& text) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file().c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }

  std::filesystem::path folder_;
};

inline std::future<bool> accept(JobStore& store, std::uint64_t number) {
  auto promise = std::make_shared<std::promise<bool>>();
  store.accept({{job(number), "body of " + std::to_string(number)}},
               [promise](bool is_written) { promise->set_value(is_written); });
  return promise->get_future();
}
inline std::future<bool> start(JobStore& store, std::uint64_t number) {
  auto promise = std::make_shared<std::promise<bool>>();
  store.about_to_move(number, [promise](bool is_written) { promise->set_value(is_written); });
  return promise->get_future();
}

}  // namespace armloom::test
