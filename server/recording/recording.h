#pragma once

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "server/recording/cell_copy.h"
#include "server/recording/states_csv.h"

namespace armloom {

// Writes a recording: events.jsonl, states.csv (if wanted), jobs.json, and cell.json with copies of
// the cell's files (cell_copy.h). With states.csv, also true_states.csv: true positions of all
// joints from the first tick in which a simulated arm is not where it is measured. Replaces an
// earlier recording in the folder. A full disk does not stop the session. fault() reports it soon,
// because each event and job is flushed at once. Not thread-safe, except that another thread may
// write states.
class Recording {
 public:
  // Returns `folder` or, if it contains a recording, a new folder in it that is named after the
  // present time ("2026-11-21T09-33-00Z"), so that a restarted server overwrites nothing.
  [[nodiscard]] static std::filesystem::path unused_folder(const std::filesystem::path& folder);

  // Creates the folder. `cell` outlives the recording. Problem (unavailable): the folder cannot be
  // written, or a file of the cell cannot be copied.
  [[nodiscard]] static Result<std::unique_ptr<Recording>> create(
      const std::filesystem::path& folder, const CellFile& source, const Cell& cell,
      bool with_states);
  ~Recording();

  void event(std::string_view json);
  void state(TimePoint time, const Configuration& q) {
    if (!states_) return;
    states_->write(time, q);
    measured_ = q;
    if (!states_->good()) note_fault("states.csv");
  }
  // Call after state() of the same tick, with the true positions.
  void truth(TimePoint time, const Configuration& q);
  // Writes all states measured until now to states.csv, so that readers find them. Call on the
  // thread that writes states.
  void catch_up_states() {
    if (!states_) return;
    errno = 0;
    states_->catch_up();
    if (!states_->good()) note_fault("states.csv");
    if (truth_) truth_->catch_up();
  }
  // See StatesWriter::at_rest.
  void at_rest(bool at_rest) {
    at_rest_ = at_rest;
    if (states_) states_->at_rest(at_rest);
    if (truth_) truth_->at_rest(at_rest);
  }
  // Both write jobs.json: call either jobs_file() with the whole text, or job() for each accepted
  // job.
  void jobs_file(std::string_view text);
  void job(TimePoint at, std::string_view body);
  // Completes and closes the files. Precondition: no other thread writes states any more.
  void close();
  // Returns the first file that could not be written and why: "events.jsonl: No space left on
  // device". Thread-safe.
  [[nodiscard]] std::optional<std::string> fault() const;
  [[nodiscard]] bool good() const { return !fault(); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  Recording() = default;
  void note_fault(const char* file);  // takes the reason from errno
  std::filesystem::path folder_;
  std::ofstream events_;
  const Cell* cell_ = nullptr;
  std::optional<StatesWriter> states_;
  std::optional<StatesWriter> truth_;  // true_states.csv
  Configuration measured_;             // in the last state()
  bool at_rest_ = false;
  std::ofstream jobs_;
  bool jobs_open_ = false;  // the JSON array in jobs.json must be closed
  bool closed_ = false;
  std::atomic<const char*> faulty_{nullptr};  // the first file that could not be written
  std::atomic<int> fault_errno_{0};
};

// Returns the alert text for a fault().
[[nodiscard]] std::string said_of_lost_recording(const std::string& fault);

inline constexpr std::size_t kTextFileMax = std::size_t{256} << 20U;

// Returns the text of a file or pipe. Problem: it cannot be read, is a folder or device (which may
// never end), or is longer than kTextFileMax.
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& file);

}  // namespace armloom
