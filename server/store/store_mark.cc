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

namespace armloom {
namespace {

struct Claim {
  std::uint64_t commits = 0;
  bool stops_are_ahead = false;
};

constexpr std::size_t kSize = 33;  // of the text, always: it is written over in its place
using Text = std::array<char, kSize + 1>;

Text text_of(const Claim& claim) {
  Text text{};
  (void)std::snprintf(text.data(), text.size(), "%020" PRIu64 " stops %s\n", claim.commits,
                      claim.stops_are_ahead ? "ahead" : "known");
  return text;
}

// Nothing: there is none, or it is none.
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

}  // namespace

StoreMark::StoreMark(const std::filesystem::path& folder, std::uint64_t commits)
    : file_(open((folder / kFile).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0640)), commits_(commits) {
  if (file_ < 0) {
    throw std::system_error(errno, std::generic_category(), (folder / kFile).string());
  }
  const auto left = claim_in(file_);
  if (!left) {
    write();  // its place on the disk
  } else {
    found_ = {left->commits > commits, left->stops_are_ahead};
    commits_ = std::max(commits, left->commits);  // as it is until something is written
  }
}

StoreMark::~StoreMark() { close(file_); }

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

// What cannot be written is not claimed; the store is told of it all the same.
void StoreMark::write() {
  const bool are_left_unknown = found_.store_is_behind || found_.stops_are_ahead;
  const bool are_ahead = stops_told_ > stops_written_ || (stops_written_ == 0 && are_left_unknown);
  const Text text = text_of({commits_, are_ahead});
  (void)!pwrite(file_, text.data(), kSize, 0);
}

}  // namespace armloom
