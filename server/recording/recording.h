#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/base/time.h"
#include "server/recording/states_csv.h"

namespace armloom {

// A recording folder being written: events.jsonl, states.csv (if asked for), cell.json with its
// paths made relative to the folder, jobs.json. Files of an earlier recording are replaced.
// A disk that fills up does not stop the run; good() says so. Not thread-safe, but states may be
// written from another thread than the rest.
class Recording {
 public:
  struct Source {
    std::filesystem::path cell_file;
    std::string cell_text;
  };
  // `folder`, or when that holds a recording already a new folder in it, named after the present
  // time ("2026-11-21T09-33-00Z"): a server that starts again loses nothing.
  [[nodiscard]] static std::filesystem::path unused_folder(const std::filesystem::path& folder);

  // Makes the folder. Problem (unavailable): it cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<Recording>> create(
      const std::filesystem::path& folder, const Source& source, const Cell& cell,
      bool with_states);
  ~Recording();

  void event(std::string_view json) { events_ << json << '\n'; }
  void state(TimePoint time, const Configuration& q) {
    if (states_) states_->write(time, q);
  }
  // As StatesWriter::at_rest.
  void at_rest(bool at_rest) {
    if (states_) states_->at_rest(at_rest);
  }
  // Either the whole jobs file at once, or job by job as they are accepted.
  void jobs_file(std::string_view text);
  void job(TimePoint at, std::string_view body);
  void flush() { events_.flush(); }
  [[nodiscard]] bool good() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  Recording() = default;
  std::filesystem::path folder_;
  std::ofstream events_;
  std::optional<StatesWriter> states_;
  std::ofstream jobs_;
  bool jobs_open_ = false;  // an array that has to be closed
};

inline constexpr std::size_t kTextFileMax = std::size_t{256} << 20U;

// A whole file, or what a pipe holds, as text. Problem: it cannot be read, is a folder or device
// (which may never end), or is longer than kTextFileMax.
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& file);

}  // namespace armloom
