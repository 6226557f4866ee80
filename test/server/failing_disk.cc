#include "test/server/failing_disk.h"

#include <sqlite3.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <mutex>
#include <vector>

namespace armloom::test {
namespace {

struct Undo {
  sqlite3_int64 offset;
  std::vector<char> before;  // shorter than the write if the file ended within it
  sqlite3_int64 size;
};

struct File {
  sqlite3_file base;
  sqlite3_file* real;  // stored right after this struct
  std::vector<Undo>* undo;
};

struct State {
  std::recursive_mutex mutex;
  std::uint64_t operations = 0;
  std::uint64_t syncs = 0;
  FailingDisk::Fault fault = FailingDisk::Fault::none;
  std::uint64_t first = 0, last = 0, nth = 0;
  std::function<void()> call;
  std::vector<File*> open;
};
State& state() {
  static State it;
  return it;
}

// Counts an operation; returns SQLITE_OK or the error with which it must fail.
int operation() {
  State& now = state();
  const std::uint64_t number = ++now.operations;
  if (number == now.nth && now.call) now.call();
  if (now.fault == FailingDisk::Fault::none || number < now.first || number > now.last) {
    return SQLITE_OK;
  }
  return now.fault == FailingDisk::Fault::full ? SQLITE_FULL : SQLITE_IOERR_WRITE;
}

File* as_ours(sqlite3_file* file) { return reinterpret_cast<File*>(file); }
sqlite3_file* real(sqlite3_file* file) { return as_ours(file)->real; }

int close_file(sqlite3_file* file) {
  const std::scoped_lock lock(state().mutex);
  std::erase(state().open, as_ours(file));
  delete as_ours(file)->undo;
  return real(file)->pMethods->xClose(real(file));
}

void remember(sqlite3_file* file, int amount, sqlite3_int64 offset) {
  Undo undo{.offset = offset, .before = {}, .size = 0};
  real(file)->pMethods->xFileSize(real(file), &undo.size);
  const sqlite3_int64 there = std::clamp<sqlite3_int64>(undo.size - offset, 0, amount);
  undo.before.resize(static_cast<std::size_t>(there));
  if (there > 0) {
    real(file)->pMethods->xRead(real(file), undo.before.data(), static_cast<int>(there), offset);
  }
  as_ours(file)->undo->push_back(std::move(undo));
}

int write_file(sqlite3_file* file, const void* bytes, int amount, sqlite3_int64 offset) {
  const std::scoped_lock lock(state().mutex);
  if (const int fault = operation(); fault != SQLITE_OK) return fault;
  remember(file, amount, offset);
  return real(file)->pMethods->xWrite(real(file), bytes, amount, offset);
}

int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
  const std::scoped_lock lock(state().mutex);
  if (const int fault = operation(); fault != SQLITE_OK) return fault;
  sqlite3_int64 now = 0;
  real(file)->pMethods->xFileSize(real(file), &now);
  if (now > size) remember(file, static_cast<int>(now - size), size);
  return real(file)->pMethods->xTruncate(real(file), size);
}

int sync_file(sqlite3_file* file, int /*flags*/) {
  const std::scoped_lock lock(state().mutex);
  if (const int fault = operation(); fault != SQLITE_OK) return fault;
  ++state().syncs;
  as_ours(file)->undo->clear();  // no real sync: the page cache outlives this process
  return SQLITE_OK;
}

const sqlite3_io_methods kMethods = [] {
  sqlite3_io_methods m{};
  m.iVersion = 2;
  m.xClose = close_file;
  m.xRead = [](sqlite3_file* f, void* to, int n, sqlite3_int64 at) {
    return real(f)->pMethods->xRead(real(f), to, n, at);
  };
  m.xWrite = write_file;
  m.xTruncate = truncate_file;
  m.xSync = sync_file;
  m.xFileSize = [](sqlite3_file* f, sqlite3_int64* n) {
    return real(f)->pMethods->xFileSize(real(f), n);
  };
  m.xLock = [](sqlite3_file* f, int how) { return real(f)->pMethods->xLock(real(f), how); };
  m.xUnlock = [](sqlite3_file* f, int how) { return real(f)->pMethods->xUnlock(real(f), how); };
  m.xCheckReservedLock = [](sqlite3_file* f, int* out) {
    return real(f)->pMethods->xCheckReservedLock(real(f), out);
  };
  m.xFileControl = [](sqlite3_file* f, int op, void* arg) {
    return real(f)->pMethods->xFileControl(real(f), op, arg);
  };
  m.xSectorSize = [](sqlite3_file* f) { return real(f)->pMethods->xSectorSize(real(f)); };
  m.xDeviceCharacteristics = [](sqlite3_file* f) {
    return real(f)->pMethods->xDeviceCharacteristics(real(f));
  };
  m.xShmMap = [](sqlite3_file* f, int page, int size, int extend, void volatile** out) {
    return real(f)->pMethods->xShmMap(real(f), page, size, extend, out);
  };
  m.xShmLock = [](sqlite3_file* f, int offset, int n, int flags) {
    return real(f)->pMethods->xShmLock(real(f), offset, n, flags);
  };
  m.xShmBarrier = [](sqlite3_file* f) { real(f)->pMethods->xShmBarrier(real(f)); };
  m.xShmUnmap = [](sqlite3_file* f, int remove) {
    return real(f)->pMethods->xShmUnmap(real(f), remove);
  };
  return m;
}();

int open_file(sqlite3_vfs* vfs, sqlite3_filename file_name, sqlite3_file* file, int flags,
              int* out) {
  auto* system = static_cast<sqlite3_vfs*>(vfs->pAppData);
  auto* ours = as_ours(file);
  std::memset(static_cast<void*>(ours), 0, sizeof *ours);
  ours->real = reinterpret_cast<sqlite3_file*>(ours + 1);
  const int code = system->xOpen(system, file_name, ours->real, flags, out);
  if (ours->real->pMethods == nullptr) return code;
  ours->base.pMethods = &kMethods;
  ours->undo = new std::vector<Undo>();
  const std::scoped_lock lock(state().mutex);
  state().open.push_back(ours);
  return code;
}

}  // namespace

const std::string& FailingDisk::name() {
  static const std::string registered = [] {
    sqlite3_initialize();
    sqlite3_vfs* system = sqlite3_vfs_find(nullptr);
    static sqlite3_vfs ours = *system;
    ours.zName = "failing-disk";
    ours.szOsFile = static_cast<int>(sizeof(File)) + system->szOsFile;
    ours.pAppData = system;
    ours.xOpen = open_file;
    sqlite3_vfs_register(&ours, 0);
    return std::string(ours.zName);
  }();
  return registered;
}

void FailingDisk::reset() {
  const std::scoped_lock lock(state().mutex);
  state().operations = state().syncs = state().nth = 0;
  state().fault = Fault::none;
  state().call = nullptr;
}

void FailingDisk::fail(Fault fault, std::uint64_t first, std::uint64_t last) {
  const std::scoped_lock lock(state().mutex);
  state().fault = fault;
  state().first = first;
  state().last = last;
}

void FailingDisk::instead_of(std::uint64_t nth, std::function<void()> call) {
  const std::scoped_lock lock(state().mutex);
  state().nth = nth;
  state().call = std::move(call);
}

void FailingDisk::lose_unsynced() {
  const std::scoped_lock lock(state().mutex);
  for (File* file : state().open) {
    for (auto undo = file->undo->rbegin(); undo != file->undo->rend(); ++undo) {
      file->real->pMethods->xWrite(file->real, undo->before.data(),
                                   static_cast<int>(undo->before.size()), undo->offset);
      file->real->pMethods->xTruncate(file->real, undo->size);
    }
    file->undo->clear();
  }
}

std::uint64_t FailingDisk::operations() {
  const std::scoped_lock lock(state().mutex);
  return state().operations;
}
std::uint64_t FailingDisk::syncs() {
  const std::scoped_lock lock(state().mutex);
  return state().syncs;
}

}  // namespace armloom::test
