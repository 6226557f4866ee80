#include "core/scheduler/making_way.h"

#include "core/trajectory/joint_line.h"

namespace armloom {

void make_way(const Scheduler& scheduler, const MoveAside& aside, Duration backlog_timeout,
              const std::function<JobId(Submit)>& submit) {
  const auto goes_on = [&](JobId id) {
    const Job* known = scheduler.find(id);
    return known != nullptr && !known->has_ended();
  };
  if (!goes_on(aside.way_of) || (aside.before && !goes_on(*aside.before))) return;
  Submit way{.job = JobId{0},
             .trajectory = aside.trajectory,
             .priority = scheduler.find(aside.way_of)->priority,
             .backlog_timeout = backlog_timeout,
             .own = true,
             .helps = aside.way_of,
             .before = aside.before};
  Submit back = way;
  const JobId goes = submit(std::move(way));
  if (!aside.before) return;
  back.trajectory = retraced(*aside.trajectory);
  back.after = {goes};
  back.helps = aside.before;
  back.lets_pass = aside.way_of;
  (void)submit(std::move(back));
}

}  // namespace armloom
