#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace armloom::test {

// A file system for SQLite that does as the real one until it is told to fail. Registered once; its
// state is the process's. Counts every write, sync and change of size of files that outlive a
// crash.
class FailingDisk {
 public:
  enum class Fault { none, full, broken };

  // Its name, for StoreOptions::vfs.
  static const std::string& name();
  static void reset();
  // Operation `first` and all after it fail, until `last`; counted from one.
  static void fail(Fault fault, std::uint64_t first, std::uint64_t last = ~std::uint64_t{0});
  // Instead of operation `nth` this is called.
  static void instead_of(std::uint64_t nth, std::function<void()> call);
  // Takes back what was written since the last sync of its file, as a power cut may.
  static void lose_unsynced();
  [[nodiscard]] static std::uint64_t operations();
  [[nodiscard]] static std::uint64_t syncs();
};

}  // namespace armloom::test
