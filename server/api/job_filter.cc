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
                        "Only jobs in this state"),
          query::text<Query>("arm", &Query::arm, "Only jobs that move this arm"),
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

JobPage select(const Status& status, std::vector<StoredJob> stored, const JobFilter& filter,
               const WallClock& clock, JobTexts& texts) {
  const auto is_wanted = [&](const JobView& job) {
    if (filter.before && job.id.value() >= *filter.before) return false;
    if (filter.state && *filter.state != job.state) return false;
    return filter.arm.empty() || std::ranges::find(job.arms, filter.arm) != job.arms.end();
  };
  std::map<std::uint64_t, ListedJob, std::greater<>> found;
  status.jobs.newest_first([&](const JobSheet::JobPtr& job) {
    if (is_wanted(*job)) found.emplace(job->id.value(), texts.of(status.with_progress(job), clock));
    return found.size() <= filter.limit;
  });
  for (StoredJob& job : stored) {
    found.emplace(job.number, std::make_shared<const std::string>(std::move(job.view)));
  }
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
