#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>

namespace armloom {

// High-water mark of the job store, in a small file beside it. Detects on opening that the store
// lost data (its log is truncated, damaged or gone, which SQLite does not notice), and that its set
// of stopped arms may be out of date. Writes reach the system at once, need no disk space and
// outlive the process. Only the file's existence is synced: after a power cut the mark may be older
// and claim less. Thread-safe.
class StoreMark {
 public:
  inline static constexpr const char* kFile = "armloom.mark";  // in the data folder

  // The claim of the previous session, compared with the store.
  struct Found {
    bool is_missing = false;  // missing or unreadable
    bool store_is_behind = false;
    bool stops_are_ahead = false;  // the store's stopped arms may be out of date
  };

  // `commits`: of the store, over all sessions; nullopt if the store does not exist yet. Creates a
  // missing mark. The mark is created before the store, so that a store without a mark has lost it.
  // Throws std::system_error.
  StoreMark(const std::filesystem::path& folder, std::optional<std::uint64_t> commits);

  [[nodiscard]] const Found& found() const { return found_; }

  // Announces a change of the set of stopped arms, before it is stored. Returns its sequence
  // number.
  [[nodiscard]] std::uint64_t stops_come();
  // Records that the store has `commits` transactions and, if given, the stop change of that
  // number.
  void written(std::uint64_t commits, std::optional<std::uint64_t> stops);

 private:
  void write();
  void write_first(const std::filesystem::path& folder);

  struct File {
    explicit File(const std::filesystem::path& path);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    int number;
  };
  File file_;
  Found found_;
  std::mutex mutex_;
  std::uint64_t commits_;
  std::uint64_t stops_told_ = 0;
  std::uint64_t stops_written_ = 0;
};

}  // namespace armloom
