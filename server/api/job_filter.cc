#include "server/api/job_filter.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace armloom {

const QueryFormat<JobFilter>& job_query() {
  using Query = JobFilter;
  static const QueryFormat<Query> format(
      {
          query::one_of("state", &Query::state, job_state_format()->schema(Way::in),
                        "In this state"),
          query::text<Query>("arm", &Query::arm, "That move this arm"),
          query::limit<Query>(&Query::limit),
          query::cursor<Query>(&Query::before),
      },
      ProblemKind::invalid);
  return format;
}

Result<JobFilter> read_job_filter(const Target& target, const Cell& cell) {
  auto filter = job_query().read(target);
  if (!filter || filter->arm.empty() || cell.find_arm(filter->arm)) return filter;
  return failure(Problem{ProblemKind::invalid, "bad-parameter", "?arm",
                         "the cell has no arm \"" + filter->arm + "\"", filter->arm});
}

JobPage select(std::vector<JobView> jobs, std::vector<StoredJob> stored, const JobFilter& filter) {
  std::map<std::uint64_t, ListedJob, std::greater<>> found;
  for (JobView& job : jobs) {
    const std::uint64_t number = job.id.value();
    if (filter.before && number >= *filter.before) continue;
    if (filter.state && *filter.state != job.state) continue;
    if (!filter.arm.empty() && std::ranges::find(job.arms, filter.arm) == job.arms.end()) continue;
    found.emplace(number, std::move(job));
  }
  for (StoredJob& job : stored) found.emplace(job.number, std::move(job.view));
  JobPage page;
  for (auto& [number, job] : found) {
    if (page.jobs.size() == filter.limit) {
      page.next_cursor = std::to_string(number + 1);
      break;
    }
    page.jobs.push_back(std::move(job));
  }
  return page;
}

}  // namespace armloom
