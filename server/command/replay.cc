#include "server/replay/replay.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "server/codec/json_writer.h"
#include "server/command/command.h"
#include "server/command/progress.h"
#include "server/messages/events.h"
#include "server/messages/problem.h"
#include "server/replay/input_file.h"

namespace armloom {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Returns the newest recording in the folder. The folder itself may be a recording.
std::optional<fs::path> newest_recording(const fs::path& data) {
  std::error_code ec;
  std::optional<fs::path> newest;
  fs::file_time_type newest_at{};
  const auto consider = [&](const fs::path& folder) {
    const auto at = fs::last_write_time(folder / InputFile::kName, ec);
    if (ec || (newest && at <= newest_at)) return;
    newest = folder;
    newest_at = at;
  };
  consider(data);
  for (const auto& entry : fs::directory_iterator(data, ec)) consider(entry.path());
  return newest;
}

// Removes wall times, because a replay cannot reproduce them from the inputs.
void drop_wall_time(Json& value) {
  if (value.is_object()) {
    for (auto it = value.begin(); it != value.end();) {
      const bool is_wall_time = it.key() == "at" || it.key().ends_with("_at");
      it = is_wall_time ? value.erase(it) : std::next(it);
    }
  }
  if (value.is_structured()) std::ranges::for_each(value, drop_wall_time);
}

std::vector<std::string> whole_lines(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (in.eof()) break;  // incomplete last line of a killed server
    lines.push_back(std::move(line));
  }
  return lines;
}

Result<std::ofstream> open_events(const std::string& folder) {
  if (folder.empty()) return std::ofstream();
  std::error_code ec;
  fs::create_directories(folder, ec);
  std::ofstream events(fs::path(folder) / "events.jsonl", std::ios::binary);
  if (events) return events;
  return failure(Problem{ProblemKind::unavailable, "cannot-write", "--out",
                         "the folder " + folder + " cannot be written", folder});
}

class EventComparison final : public Observer {
 public:
  // `out`: receives the replayed events, if open.
  EventComparison(std::vector<std::string> recorded, std::ofstream out)
      : recorded_(std::move(recorded)), out_(std::move(out)) {}
  void on_event(const Event& event) override {
    const std::string replayed = event_json(event, stream(), nullptr);
    if (out_.is_open()) out_ << replayed << '\n';
    if (events_ < recorded_.size() && !differs_) compare(recorded_[events_], replayed);
    ++events_;
  }
  void on_tick(TimePoint now, const Configuration&) override {
    if (progress_ != nullptr) progress_->cell_time(to_seconds(now));
  }
  void show(Progress* progress) { progress_ = progress; }
  void on_state(const StateFrame&) override {}

  [[nodiscard]] TimePoint end() const {
    if (recorded_.empty()) return TimePoint{};
    const Json last = Json::parse(recorded_.back(), nullptr, false);
    return TimePoint(from_seconds(last.value("t_s", 0.0)));
  }
  // If an event that was recorded until `time` was not replayed, reports this as the difference.
  void expect_all_until(TimePoint time) {
    if (differs_ || events_ >= recorded_.size()) return;
    const Json next = Json::parse(recorded_[events_], nullptr, false);
    if (TimePoint(from_seconds(next.value("t_s", 0.0))) > time) return;
    differs_ = {recorded_[events_], "nothing"};
  }
  struct Difference {
    std::string recorded, replayed;
  };
  [[nodiscard]] const std::optional<Difference>& difference() const { return differs_; }
  [[nodiscard]] std::size_t events() const { return events_; }
  // Returns the number of compared events. Later events were not on disk when the server ended, so
  // they cannot be compared.
  [[nodiscard]] std::size_t compared() const { return std::min(events_, recorded_.size()); }
  // Returns true if events were replayed, but none was recorded.
  [[nodiscard]] bool is_void() const { return compared() == 0 && events_ > 0; }
  [[nodiscard]] bool is_written() const { return !out_.is_open() || out_.good(); }

 private:
  [[nodiscard]] std::string stream() const {
    if (recorded_.empty()) return "replay";
    return Json::parse(recorded_.front(), nullptr, false).value("stream", "replay");
  }
  void compare(const std::string& recorded, const std::string& replayed) {
    Json told = Json::parse(recorded, nullptr, false);
    drop_wall_time(told);
    if (told.dump() == Json::parse(replayed).dump()) return;
    differs_ = {told.dump(), replayed};
  }

  std::vector<std::string> recorded_;
  std::ofstream out_;
  Progress* progress_ = nullptr;
  std::size_t events_ = 0;
  std::optional<Difference> differs_;
};

struct Run {
  std::size_t inputs = 0;
  TimePoint ended{};
};

// Replays the inputs of the log until cell time `until`. Problems: faults of the log.
Result<Run> run(Replay& replay, const std::vector<std::string>& lines,
                std::optional<TimePoint> until) {
  Run done;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto at = Replay::time_of(lines[i]);
    if (until && at && *at > *until) break;
    if (auto taken = replay.take(lines[i]); !taken) {
      taken.error().front().pointer = "line " + std::to_string(i + 1);
      return failure(std::move(taken.error()));
    }
    ++done.inputs;
  }
  return done;
}

int tell(const fs::path& folder, const Run& done, const EventComparison& comparison) {
  const auto& difference = comparison.difference();
  if (difference) {
    std::cerr << "armloom: recorded: " << difference->recorded << '\n'
              << "armloom: replayed: " << difference->replayed << '\n';
  } else if (comparison.compared() < comparison.events()) {
    std::cerr << "armloom: " << comparison.compared() << " of " << comparison.events()
              << " events were compared: events.jsonl has no more\n";
  }
  JsonWriter out;
  out.begin_object().field("recording", folder.string()).field("ended_s", done.ended);
  out.field("inputs", done.inputs).field("events", comparison.events());
  out.field("compared", comparison.compared());
  out.field("same", comparison.is_void() ? std::nullopt : std::optional(!difference));
  out.end_object();
  std::cout << out.text() << std::endl;
  return difference || comparison.is_void() ? 1
         : comparison.is_written()          ? kExitDone
                                            : kExitNotWritten;
}

}  // namespace

int replay_recording(const ReplayOptions& options) {
  const auto folder = options.recording.empty() ? newest_recording(options.data)
                                                : std::optional<fs::path>(options.recording);
  const auto lines = folder ? whole_lines(*folder / InputFile::kName) : std::vector<std::string>{};
  if (lines.empty()) {
    const std::string& asked = options.recording.empty() ? options.data : options.recording;
    return refuse("", {Problem{ProblemKind::not_found, "no-log",
                               options.recording.empty() ? "--data" : "--recording",
                               "no " + std::string(InputFile::kName) + " in " + asked +
                                   ": record with `serve --data`",
                               asked}});
  }
  const auto loaded = load_cell((*folder / "cell.json").string());
  if (!loaded) return kExitBadInput;
  auto out = open_events(options.out);
  if (!out) return refuse("", out.error());
  EventComparison comparison(whole_lines(*folder / "events.jsonl"), *std::move(out));
  auto replay = Replay::begin(loaded->cell, lines.front(), comparison);
  if (!replay) return refuse((*folder / InputFile::kName).string(), replay.error());
  // The replay ends here, because later inputs are unknown.
  const TimePoint end =
      std::max(comparison.end(), Replay::time_of(lines.back()).value_or(TimePoint{}));
  std::optional<TimePoint> until;
  if (options.until_s) until = std::min(end, TimePoint(from_seconds(*options.until_s)));
  std::optional<Progress> progress(std::in_place, "replay");
  comparison.show(&*progress);
  auto done = run(**replay, lines, until);
  if (!done) {
    complain((*folder / InputFile::kName).string(), done.error());
    return done.error().front().slug == "diverged" ? 1 : kExitBadInput;
  }
  (*replay)->run_until(until.value_or(end));
  comparison.show(nullptr);
  progress.reset();
  done->ended = (*replay)->executive().now();
  comparison.expect_all_until(done->ended);
  return tell(*folder, *done, comparison);
}

}  // namespace armloom
