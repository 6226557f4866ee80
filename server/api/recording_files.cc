#include "server/api/recording_files.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "server/codec/rfc3339.h"
#include "server/codec/wall_clock.h"
#include "server/recording/kept_recordings.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;

std::string wall_time(fs::file_time_type time) {
  const auto wall = fs::file_time_type::clock::to_sys(time);
  return rfc3339(since_1970_ms(std::chrono::floor<std::chrono::milliseconds>(wall)));
}

RecordingView view_of(const KeptRecording& kept, bool is_running) {
  RecordingView view{.name = kept.name,
                     .begun_at = kept.begun ? std::optional(wall_time(*kept.begun)) : std::nullopt,
                     .written_at = wall_time(kept.written),
                     .is_running = is_running,
                     .files = {}};
  for (const KeptRecording::File& file : kept.files) {
    view.files.push_back({file.name, file.bytes});
    if (file.name == "states.csv") view.has_states = true;
  }
  return view;
}

// Returns the size of the file up to the end of its last complete line.
tl::expected<std::size_t, NoFile> whole_lines(const OpenFile& file) {
  constexpr std::size_t kPiece = std::size_t{64} * 1024;
  for (std::size_t end = file.size(); end > 0;) {
    const std::size_t from = end > kPiece ? end - kPiece : 0;
    const auto piece = file.read(from, end - from);
    if (!piece) return tl::unexpected(piece.error());
    if (const std::size_t last = piece->rfind('\n'); last != piece->npos) return from + last + 1;
    end = from;
  }
  return 0;
}

// Counts an open file until it is closed.
struct Counted {
  explicit Counted(std::shared_ptr<std::atomic<std::size_t>> of)
      : open(std::move(of)), others(open->fetch_add(1)) {}
  ~Counted() { open->fetch_sub(1); }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

  std::shared_ptr<std::atomic<std::size_t>> open;
  std::size_t others;
  std::optional<OpenFile> file = {};
};

}  // namespace

RecordingList RecordingFiles::list() const {
  RecordingList list;
  if (!data_) return list;
  list.is_kept = true;
  for (const KeptRecording& kept : recordings_in(*data_)) {
    list.recordings.push_back(view_of(kept, is_running(kept.name)));
  }
  std::ranges::reverse(list.recordings);
  return list;
}

bool RecordingFiles::is_running(const std::string& name) const {
  return data_ && running_ != nullptr && folder_of_recording(*data_, name) == running_->folder();
}

tl::expected<RecordingFiles::Opened, NoFile> RecordingFiles::open(const std::string& name,
                                                                  const std::string& file) const {
  if (!data_ || !is_file_of_recording(file)) return tl::unexpected(NoFile::absent);
  std::error_code ec;
  const auto folder = folder_of_recording(fs::canonical(*data_, ec), name);
  if (ec || !folder) return tl::unexpected(NoFile::absent);
  const auto counted = std::make_shared<Counted>(open_);
  if (counted->others >= kOpenMax) return tl::unexpected(NoFile::busy);
  const fs::path path = *folder / file;
  auto opened = OpenFile::open(path, std::numeric_limits<std::size_t>::max());
  if (!opened) return tl::unexpected(opened.error());
  if (opened->place() != path)
    return tl::unexpected(NoFile::absent);  // reached through a symbolic link
  const OpenFile& held = counted->file.emplace(std::move(*opened));
  Opened result{std::shared_ptr<const OpenFile>(counted, &held), held.size()};
  if (!is_running(name)) return result;
  const auto whole = whole_lines(*result.file);
  if (!whole) return tl::unexpected(whole.error());
  result.size = *whole;
  return result;
}

}  // namespace armloom
