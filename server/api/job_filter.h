#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "core/executive/events.h"
#include "core/executive/status_board.h"
#include "core/model/cell.h"
#include "server/api/listings.h"
#include "server/api/query_format.h"
#include "server/messages/job.h"
#include "server/store/stored_job.h"

namespace armloom {

// The query of GET /jobs: ?state=&arm=&limit=&cursor=
struct JobFilter {
  std::optional<JobState> state;
  std::string arm;  // any arm if empty
  std::size_t limit = query::kPage;
  std::optional<std::uint64_t> before;  // the cursor: only jobs submitted before this one
};

[[nodiscard]] const QueryFormat<JobFilter>& job_query();
// Problems (invalid): a query parameter that cannot be read, or an unknown arm.
[[nodiscard]] Result<JobFilter> read_job_filter(const Target& target, const Cell& cell);

// Merges the executive's jobs and the `stored` jobs into a page. Precondition: `stored` is already
// filtered and sorted (newest first), and contains no job of the executive.
[[nodiscard]] JobPage select(const Status& status, std::vector<StoredJob> stored,
                             const JobFilter& filter, const WallClock& clock, JobTexts& texts);

}  // namespace armloom
