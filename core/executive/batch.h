#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/executive/executive.h"
#include "core/executive/job_intake.h"

namespace armloom {

// A batch of jobs, submitted in chunks. An atomic batch is first checked as a whole, which is fast
// if its motions are already validated (validated.h). Then its jobs are accepted one after the
// other, and none can be refused any more.
class Executive::Batch {
 public:
  Batch(Impl& taker, std::vector<JobRequest> asked, bool all_or_none)
      : executive(taker), requests(std::move(asked)), atomic(all_or_none) {}

  // Takes the next chunk. Returns the answers after the last one.
  [[nodiscard]] std::optional<BatchAnswers> go_on();

  Impl& executive;
  std::vector<JobRequest> requests;
  const bool atomic;
  std::optional<std::vector<PreparedJob>> prepared = {};  // atomic: the checked jobs
  std::size_t next = 0;
  std::vector<Result<JobView>> answers = {};
};

}  // namespace armloom
