#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace armloom::test {

// A SQLite VFS that can be made to fail. Registered once; its state is global. Its operations are
// the writes, syncs and truncations of files that outlive a crash.
class FailingDisk {
 public:
  enum class Fault { none, full, broken };

  // Returns the name for StoreOptions::vfs.
  static const std::string& name();
  static void reset();
  // Makes the operations from `first` to `last` fail, counted from one.
  static void fail(Fault fault, std::uint64_t first, std::uint64_t last = ~std::uint64_t{0});
  // Calls `call` just before operation `nth`.
  static void instead_of(std::uint64_t nth, std::function<void()> call);
  // Reverts all writes since each file's last sync, as a power cut may.
  static void lose_unsynced();
  [[nodiscard]] static std::uint64_t operations();
  [[nodiscard]] static std::uint64_t syncs();
};

}  // namespace armloom::test
