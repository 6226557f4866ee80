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
// `observer`. One thread.
class Replay {
 public:
  // `head`: first line of the log. Problems: it is invalid or of another version; those of
  // Executive::create(). The observer outlives this.
  [[nodiscard]] static Result<std::unique_ptr<Replay>> begin(CellPtr cell, std::string_view head,
                                                             Observer& observer);
  ~Replay();

  // Runs all cycles before the next line, then applies the line. Problems: it is invalid;
  // `diverged`: this executive behaves differently (another program or cell).
  [[nodiscard]] Result<void> take(std::string_view line);
  // Runs cycles without inputs.
  void run_until(TimePoint time);
  // Returns the time of the cycle before which the line's input arrived, or nullopt if the line is
  // invalid.
  [[nodiscard]] static std::optional<TimePoint> time_of(std::string_view line);

  [[nodiscard]] const Executive& executive() const;

 private:
  class Impl;
  explicit Replay(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
