// LD_PRELOAD library for tests of power cuts. Keeps a copy of each file of a folder as of its last
// sync. Can also end the process instead of a sync. Environment:
// - ARMLOOM_SYNCED_OF: the folder
// - ARMLOOM_SYNCED_TO: the copy
// - ARMLOOM_CUT_AT: number of the sync that ends the process (0: none)
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Sync = int (*)(int);

struct Copy {
  fs::path of = std::getenv("ARMLOOM_SYNCED_OF");
  fs::path to = std::getenv("ARMLOOM_SYNCED_TO");
  std::uint64_t cut_at = std::strtoull(std::getenv("ARMLOOM_CUT_AT"), nullptr, 10);
  std::mutex mutex;
  std::uint64_t syncs = 0;
};
Copy& copy() {
  static Copy it;
  return it;
}

int real_rename(const char* from, const char* to) {
  static const auto real =
      reinterpret_cast<int (*)(const char*, const char*)>(dlsym(RTLD_NEXT, "rename"));
  return real(from, to);
}

// Replaces the copy atomically, because the process may be killed meanwhile.
void keep_file(const fs::path& from, const fs::path& to) {
  const fs::path part = copy().to.string() + ".part";
  fs::create_directories(to.parent_path());
  fs::copy_file(from, part, fs::copy_options::overwrite_existing);
  real_rename(part.c_str(), to.c_str());
}

// A removal from the folder is durable once the folder itself is synced.
void keep_removals(const fs::path& from, const fs::path& to) {
  if (!fs::exists(to)) return;
  const std::vector<fs::directory_entry> kept(fs::directory_iterator(to), {});
  for (const auto& entry : kept) {
    if (!fs::exists(from / entry.path().filename())) fs::remove_all(entry.path());
  }
}

int sync_and_keep(int fd, const char* name) {
  const auto real = reinterpret_cast<Sync>(dlsym(RTLD_NEXT, name));
  std::error_code unknown;
  const fs::path file = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), unknown);
  const fs::path within = file.lexically_relative(copy().of);
  if (unknown || within.empty() || *within.begin() == "..") return real(fd);
  const std::scoped_lock lock(copy().mutex);
  if (++copy().syncs == copy().cut_at) {
    (void)kill(getpid(), SIGKILL);
    pause();
  }
  const int result = real(fd);
  if (result != 0 || !fs::exists(file)) return result;
  const fs::path to = (copy().to / within).lexically_normal();
  fs::is_directory(file) ? keep_removals(file, to) : keep_file(file, to);
  return result;
}

}  // namespace

// A rename takes effect in the copy, too, if the file has been synced.
extern "C" int rename(const char* from, const char* to) {
  const auto within = [](const char* name) {
    return fs::weakly_canonical(name).lexically_relative(copy().of);
  };
  const fs::path old_name = within(from);
  if (old_name.empty() || *old_name.begin() == "..") return real_rename(from, to);
  const std::scoped_lock lock(copy().mutex);
  const int result = real_rename(from, to);
  const fs::path kept = copy().to / old_name;
  if (result == 0 && fs::exists(kept)) real_rename(kept.c_str(), (copy().to / within(to)).c_str());
  return result;
}

extern "C" int fsync(int fd) { return sync_and_keep(fd, "fsync"); }
extern "C" int fdatasync(int fd) { return sync_and_keep(fd, "fdatasync"); }
