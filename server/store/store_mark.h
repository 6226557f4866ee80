#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>

namespace armloom {

// What the store of a data folder must hold at least, in a small file beside it: one that holds
// less when it is opened again has lost something, as where its log is cut off, damaged or gone,
// which SQLite takes for the end of it; and whether arms were stopped that it may not know of.
// It is handed to the system at once, takes no new room on the disk, and outlives the process. Only
// that there is one is synced: a power cut may leave an older one, which claims less. Thread-safe.
class StoreMark {
 public:
  inline static constexpr const char* kFile = "armloom.mark";  // in the data folder

  // What the former run claimed, held against the store as it is.
  struct Found {
    bool is_missing = false;  // there is none, or none that can be read
    bool store_is_behind = false;
    bool stops_are_ahead = false;  // which arms were stopped may not be what the store says
  };

  // `commits`: that the store has, over all runs; none: it is not made yet, or was an older
  // version's, which made no mark. Where there is none it is made; before the store is, so that one
  // without it has lost it. Throws std::system_error.
  StoreMark(const std::filesystem::path& folder, std::optional<std::uint64_t> commits);

  [[nodiscard]] const Found& found() const { return found_; }

  // Which arms are stopped is about to be handed to the store; the number by which that is known.
  [[nodiscard]] std::uint64_t stops_come();
  // The store has so many commits, with the stops of this number.
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
