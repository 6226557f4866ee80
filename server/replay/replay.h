#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/executive/executive.h"

namespace armloom {

// Runs an executive again from its input log (input_format.h): applies each input at its control
// cycle and computes verdicts and plans again. Reaches the same state and passes the same events to
// `observer`. Use on one thread.
class Replay {
 public:
  // `head`: first line of the log. Problems: the head is invalid or of another version; those of
  // Executive::create(). The observer must outlive the Replay.
  [[nodiscard]] static Result<std::unique_ptr<Replay>> begin(CellPtr cell, std::string_view head,
                                                             Observer& observer);
  ~Replay();

  // Runs all cycles up to the line's cycle, then applies the line. Problems: the line is invalid;
  // `diverged`: this executive behaves differently (another program or cell).
  [[nodiscard]] Result<void> take(std::string_view line);
  // Runs all cycles until `time`, without inputs.
  void run_until(TimePoint time);
  // Returns the time of the first cycle after the line's input, or nullopt if the line is invalid.
  [[nodiscard]] static std::optional<TimePoint> time_of(std::string_view line);

  [[nodiscard]] const Executive& executive() const;

 private:
  class Impl;
  explicit Replay(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
