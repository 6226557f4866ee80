#include "core/scheduler/yielding/making_way.h"

#include "core/trajectory/joint_line.h"

namespace armloom {

void make_way(const Scheduler& scheduler, const YieldMove& aside, Duration backlog_timeout,
              const std::function<JobId(Submit)>& submit) {
  const auto goes_on = [&](JobId id) {
    const Job* known = scheduler.find(id);
    return known != nullptr && !known->has_ended();
  };
  if (!goes_on(aside.blocked_job) || (aside.before && !goes_on(*aside.before))) return;
  Submit way{.job = JobId{0},
             .trajectory = aside.trajectory,
             .priority = scheduler.find(aside.blocked_job)->priority,
             .backlog_timeout = backlog_timeout,
             .system_job = true,
             .on_behalf_of = aside.blocked_job,
             .before = aside.before};
  Submit back = way;
  const JobId goes = submit(std::move(way));
  if (!aside.before) return;
  back.trajectory = retraced(*aside.trajectory);
  back.after = {goes};
  back.on_behalf_of = aside.before;
  back.lets_pass = aside.blocked_job;
  (void)submit(std::move(back));
}

}  // namespace armloom
