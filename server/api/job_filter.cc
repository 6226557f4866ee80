#include "server/api/job_filter.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "server/api/query_number.h"

namespace armloom {
namespace {

bool known_state(const std::string& name) {
  return std::ranges::any_of(kJobStates, [&](JobState state) { return name == to_string(state); });
}

}  // namespace

Result<JobFilter> read_job_filter(const Target& target, const Cell& cell) {
  JobFilter filter;
  Problems problems;
  const auto refuse = [&](const std::string& name, const std::string& value, std::string detail) {
    problems.push_back(
        Problem{ProblemKind::invalid, "bad-parameter", "?" + name, std::move(detail), value});
  };
  for (const auto& [name, value] : target.query) {
    if (name == "state") {
      filter.state = value;
      if (!known_state(value)) refuse(name, value, "no state of a job is called \"" + value + "\"");
    } else if (name == "arm") {
      filter.arm = value;
      if (!cell.find_arm(value)) refuse(name, value, "the cell has no arm \"" + value + "\"");
    } else if (name == "limit") {
      if (!read_between<std::size_t>(value, 1, JobFilter::kLimitMax, filter.limit)) {
        refuse(name, value, "limit is an integer within 1..1000, found \"" + value + "\"");
      }
    } else if (name == "cursor") {
      std::uint64_t before = 0;
      if (read_between<std::uint64_t>(value, 0, ~std::uint64_t{0}, before)) {
        filter.before = before;
      } else {
        refuse(name, value, "this is no cursor that the server gave: \"" + value + "\"");
      }
    }
  }
  if (!problems.empty()) return failure(std::move(problems));
  return filter;
}

JobPage select(std::vector<JobView> jobs, std::vector<StoredJob> stored, const JobFilter& filter) {
  std::map<std::uint64_t, ListedJob, std::greater<>> found;
  for (JobView& job : jobs) {
    const std::uint64_t number = job.id.value();
    if (filter.before && number >= *filter.before) continue;
    if (!filter.state.empty() && filter.state != to_string(job.state)) continue;
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
