#include "server/store/store_mark.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <string>
#include <system_error>

#include "server/store/sync_folder.h"

namespace armloom {
namespace {

struct Claim {
  std::uint64_t commits = 0;
  bool stops_are_ahead = false;
};

constexpr std::size_t kSize = 33;  // bytes of the text, which is overwritten in place
using Text = std::array<char, kSize + 1>;

Text text_of(const Claim& claim) {
  Text text{};
  (void)std::snprintf(text.data(), text.size(), "%020" PRIu64 " stops %s\n", claim.commits,
                      claim.stops_are_ahead ? "ahead" : "known");
  return text;
}

// Returns nullopt if there is no valid mark.
std::optional<Claim> claim_in(int file) {
  Text text{};
  Claim claim;
  if (pread(file, text.data(), kSize, 0) != static_cast<ssize_t>(kSize)) return std::nullopt;
  if (std::sscanf(text.data(), "%20" SCNu64, &claim.commits) != 1) return std::nullopt;
  for (const bool are_ahead : {false, true}) {
    claim.stops_are_ahead = are_ahead;
    if (text_of(claim) == text) return claim;
  }
  return std::nullopt;
}

std::system_error fault(const std::filesystem::path& file) {
  return {errno, std::generic_category(), file.string()};
}

}  // namespace

StoreMark::File::File(const std::filesystem::path& path)
    : number(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0640)) {
  if (number < 0) throw fault(path);
}

StoreMark::File::~File() { close(number); }

StoreMark::StoreMark(const std::filesystem::path& folder, std::optional<std::uint64_t> commits)
    : file_(folder / kFile), commits_(commits.value_or(0)) {
  if (const auto left = claim_in(file_.number)) {
    found_ = {false, left->commits > commits_, left->stops_are_ahead};
    commits_ = std::max(commits_, left->commits);  // until the next write
  } else {
    found_.is_missing = commits.has_value();
    write_first(folder);
  }
}

// Syncs the file and its folder, so that the mark's existence and space survive a power cut.
void StoreMark::write_first(const std::filesystem::path& folder) {
  const Text text = text_of({commits_, found_.is_missing});
  const bool is_written =
      ftruncate(file_.number, 0) == 0 &&
      pwrite(file_.number, text.data(), kSize, 0) == static_cast<ssize_t>(kSize) &&
      fsync(file_.number) == 0;
  if (!is_written) throw fault(folder / kFile);
  sync_folder(folder);
}

std::uint64_t StoreMark::stops_come() {
  const std::scoped_lock lock(mutex_);
  ++stops_told_;
  write();
  return stops_told_;
}

void StoreMark::written(std::uint64_t commits, std::optional<std::uint64_t> stops) {
  const std::scoped_lock lock(mutex_);
  commits_ = commits;
  if (stops) stops_written_ = std::max(stops_written_, *stops);
  write();
}

// Ignores a failed write: the mark then claims less than it should.
void StoreMark::write() {
  const bool are_left_unknown =
      found_.is_missing || found_.store_is_behind || found_.stops_are_ahead;
  const bool are_ahead = stops_told_ > stops_written_ || (stops_written_ == 0 && are_left_unknown);
  const Text text = text_of({commits_, are_ahead});
  (void)!pwrite(file_.number, text.data(), kSize, 0);
}

}  // namespace armloom
