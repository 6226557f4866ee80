#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/executive/executive.h"
#include "core/executive/job_intake.h"

namespace armloom {

// Several jobs that were submitted at once, as far as they are taken. An atomic one is looked at as
// a whole first, which is quick where its motions are validated; then one job after the other is
// accepted, and none can be refused any more.
class Executive::Batch {
 public:
  Batch(Impl& taker, std::vector<JobRequest> asked, bool all_or_none)
      : executive(taker), requests(std::move(asked)), atomic(all_or_none) {}

  // Takes the next part. The answers, when nothing is left.
  [[nodiscard]] std::optional<BatchAnswers> go_on();

  Impl& executive;
  std::vector<JobRequest> requests;
  const bool atomic;
  std::optional<std::vector<PreparedJob>> prepared = {};  // atomic: all that is accepted
  std::size_t next = 0;
  std::vector<Result<JobView>> answers = {};
};

}  // namespace armloom
