#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>

namespace armloom {

// High-water mark of the job store, in a small file beside the store. When the store is opened, the
// mark shows two faults:
// - The store lost data: its log is truncated, damaged or gone, which SQLite does not notice.
// - The stored set of stopped arms may be out of date.
// A written mark reaches the operating system at once and outlives the process. Writing needs no
// further disk space. Only the creation of the file is synced: after a power cut, the mark may be
// older and claim less. Thread-safe.
class StoreMark {
 public:
  inline static constexpr const char* kFile = "armloom.mark";  // in the data folder

  // Differences between the mark of the previous session and the store.
  struct Found {
    bool is_missing = false;  // missing or unreadable
    bool store_is_behind = false;
    bool stops_are_ahead = false;  // the store's stopped arms may be out of date
  };

  // `commits`: number of commits of the store over all sessions; nullopt if the store does not
  // exist yet. Creates a missing mark. Create the mark before the store: then a store without a
  // mark must have lost it. Throws std::system_error.
  StoreMark(const std::filesystem::path& folder, std::optional<std::uint64_t> commits);

  [[nodiscard]] const Found& found() const { return found_; }

  // Announces a change of the set of stopped arms. Call before the change is stored. Returns the
  // sequence number of the change.
  [[nodiscard]] std::uint64_t stops_come();
  // Records that the store now has `commits` transactions. `stops`, if given, is the sequence
  // number of the change of stopped arms that the store now contains.
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
