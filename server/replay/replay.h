#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/executive/executive.h"

namespace armloom {

// Runs an executive again from the log of its inputs (input_format.h): each at the control cycle at
// which it came, verdicts and plans computed anew. Comes to the same state, and tells `observer`
// the same events. On one thread.
class Replay {
 public:
  // `head`: the first line of the log. Problems: it is none, or another version's; those of
  // Executive::create(). The observer outlives it.
  [[nodiscard]] static Result<std::unique_ptr<Replay>> begin(CellPtr cell, std::string_view head,
                                                             Observer& observer);
  ~Replay();

  // The next line: first all cycles before it. Problems: it cannot be read; `diverged`: this
  // executive is not as the logged one was, as with another program or cell.
  [[nodiscard]] Result<void> take(std::string_view line);
  // Cycles without inputs.
  void run_until(TimePoint time);
  // Of the cycle before which the line's input came; nothing: it cannot be read.
  [[nodiscard]] static std::optional<TimePoint> time_of(std::string_view line);

  [[nodiscard]] const Executive& executive() const;

 private:
  class Impl;
  explicit Replay(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace armloom
