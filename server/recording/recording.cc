#include "server/recording/recording.h"

#include <cerrno>
#include <ctime>
#include <system_error>
#include <utility>
#include <vector>

#include "server/codec/json_writer.h"

namespace armloom {
namespace fs = std::filesystem;

fs::path Recording::unused_folder(const fs::path& folder) {
  std::error_code ec;
  if (!fs::exists(folder / "events.jsonl", ec)) return folder;
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char name[32];
  std::strftime(name, sizeof name, "%Y-%m-%dT%H-%M-%SZ", &parts);
  fs::path fresh = folder / name;
  for (int n = 2; fs::exists(fresh, ec); ++n) {
    fresh = folder / (name + ("." + std::to_string(n)));
  }
  return fresh;
}

Result<std::unique_ptr<Recording>> Recording::create(const fs::path& folder, const CellFile& source,
                                                     const Cell& cell, bool with_states) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  std::unique_ptr<Recording> recording(new Recording());
  recording->folder_ = folder;
  recording->events_.open(folder / "events.jsonl", std::ios::binary);
  std::ofstream cell_copy(folder / "cell.json", std::ios::binary);
  if (!recording->events_ || !cell_copy) {
    return failure(Problem{ProblemKind::unavailable, "cannot-write", folder.string(),
                           "the folder " + folder.string() + " cannot be written",
                           folder.string()});
  }
  const auto cell_text = copy_cell(source, folder);
  if (!cell_text) return failure(cell_text.error());
  errno = 0;
  cell_copy << *cell_text << std::flush;
  if (!cell_copy) {
    return failure(Problem{ProblemKind::unavailable, "cannot-write", folder.string(),
                           "the folder " + folder.string() +
                               " cannot be written: " + std::generic_category().message(errno),
                           folder.string()});
  }
  if (with_states) {
    recording->states_.emplace(folder / "states.csv", cell);
  } else {
    fs::remove(folder / "states.csv", ec);  // of an earlier recording
    fs::remove(idle_file_of(folder / "states.csv"), ec);
  }
  fs::remove(folder / kTrueStates, ec);
  fs::remove(idle_file_of(folder / kTrueStates), ec);
  recording->cell_ = &cell;
  return recording;
}

Recording::~Recording() { close(); }

void Recording::note_fault(const char* file) {
  const int why = errno;
  const char* none = nullptr;
  if (faulty_.compare_exchange_strong(none, file)) fault_errno_ = why;
}

std::optional<std::string> Recording::fault() const {
  const char* file = faulty_;
  if (file == nullptr) return std::nullopt;
  const int why = fault_errno_;
  return file + std::string(": ") +
         (why == 0 ? "cannot be written" : std::generic_category().message(why));
}

// A recording with a gap could not be replayed, so recording ends for this session.
std::string said_of_lost_recording(const std::string& fault) {
  return "the recording is incomplete: " + fault +
         "; the cell continues without recording until the server is restarted and can write";
}

void Recording::event(std::string_view json) {
  errno = 0;
  events_ << json << '\n' << std::flush;
  if (!events_) note_fault("events.jsonl");
}

void Recording::truth(TimePoint time, const Configuration& q) {
  if (!states_ || (!truth_ && q == measured_)) return;
  errno = 0;
  if (!truth_) {
    truth_.emplace(folder_ / kTrueStates, *cell_);
    truth_->at_rest(at_rest_);
  }
  truth_->write(time, q);
  if (!truth_->good()) note_fault("true_states.csv");
}

void Recording::jobs_file(std::string_view text) {
  errno = 0;
  std::ofstream file(folder_ / "jobs.json", std::ios::binary);
  file << text << std::flush;
  if (!file) note_fault("jobs.json");
}

void Recording::job(TimePoint at, std::string_view body) {
  errno = 0;
  if (!jobs_open_) jobs_.open(folder_ / "jobs.json", std::ios::binary);
  JsonWriter line;
  line.begin_object().field("at", at).key("job").raw(body).end_object();
  jobs_ << (jobs_open_ ? ",\n" : "[\n") << line.text() << std::flush;
  jobs_open_ = true;
  if (!jobs_) note_fault("jobs.json");
}

void Recording::close() {
  if (std::exchange(closed_, true)) return;
  errno = 0;
  events_.close();
  if (!events_) note_fault("events.jsonl");
  if (states_ && !states_->close()) note_fault("states.csv");
  if (truth_ && !truth_->close()) note_fault("true_states.csv");
  if (!jobs_open_) return;
  jobs_ << "\n]\n";
  jobs_.close();
  if (!jobs_) note_fault("jobs.json");
}

Result<std::string> read_text_file(const fs::path& file) {
  const auto refuse = [](ProblemKind kind, const char* slug, std::string detail) {
    return failure(Problem{kind, slug, "", std::move(detail), {}});
  };
  std::error_code ec;
  const auto status = fs::status(file, ec);
  const bool may_end = fs::is_regular_file(status) || fs::is_fifo(status);
  if (fs::exists(status) && !may_end) {
    return refuse(ProblemKind::invalid, "cannot-read", "it is neither a file nor a pipe");
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    return refuse(ProblemKind::not_found, "cannot-read",
                  "the file does not exist or cannot be read");
  }
  std::string text;
  std::vector<char> piece(1U << 20U);
  while (in && text.size() <= kTextFileMax) {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (text.size() <= kTextFileMax) return text;
  return refuse(ProblemKind::too_large, "file-too-large",
                "it is longer than " + std::to_string(kTextFileMax) + " bytes");
}

}  // namespace armloom
