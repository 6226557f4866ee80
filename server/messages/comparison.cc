#include "server/messages/comparison.h"

#include <algorithm>

#include "core/executive/known_policies.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/output_part.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"

namespace armloom {

using namespace formats;

FormatPtr<ComparisonInquiry> comparison_inquiry_format() {
  using Inquiry = ComparisonInquiry;
  static const auto format = named(
      "ComparisonRequest", "",
      object<Inquiry>({
          field(
              "policies", &Inquiry::policies,
              list(one_of(known_policies()), {.most = known_policies().size(), .noun = "policies"}),
              "Policies to simulate, in this order; all if empty"),
          field("since_s", &Inquiry::since, cell_time(),
                "Includes only jobs submitted at this cell time or later"),
          field("seed", &Inquiry::seed, count(),
                "Seed of the simulation; the same seed gives the same result"),
      }));
  return format;
}

Result<ComparisonInquiry> read_comparison_inquiry(std::string_view text) {
  auto inquiry = read_text(*comparison_inquiry_format(), text);
  if (!inquiry) return inquiry;
  const auto& names = inquiry->policies;
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) == name) continue;
    return failure(Problem{ProblemKind::invalid, "twice",
                           "/policies/" + std::to_string(name - names.begin()),
                           "policy \"" + *name + "\" is listed twice: remove one", *name});
  }
  return inquiry;
}

namespace {

FormatPtr<PolicyRun> policy_run_format() {
  using Run = PolicyRun;
  return named(
      "PolicyRun", "Simulated outcome of the jobs under one policy.",
      object<Run>({
          output_only("policy", &Run::policy, text()),
          output_only("succeeded", &Run::succeeded, count()),
          output_only("expired", &Run::expired, count()),
          output_only("failed", &Run::failed, count()),
          output_only("canceled", &Run::canceled, count(),
                      "Jobs canceled by the server, interrupted jobs included"),
          output_only(
              "refused", &Run::refused, count(),
              "Jobs refused on submission, because the job would not begin where its arm would be"),
          output_only("unfinished", &Run::unfinished, count(),
                      "Jobs that had not ended when nothing could move any more, or when the "
                      "simulation was given up"),
          output_only("backlogged", &Run::backlogged, count(),
                      "Jobs that waited in the backlog at least once"),
          output_only("makespan_s", &Run::makespan, nullable(seconds({0.0})),
                      "Time from the first submission to the last end; null if a job did not end "
                      "or no job started"),
          output_only("makespan_ratio", &Run::makespan_ratio, nullable(number({0.0})),
                      "`makespan_s` divided by that of `sequential`; null if unknown"),
          output_only("wait_mean_s", &Run::wait_mean, seconds({0.0}),
                      "Mean time from submission to start"),
          output_only("wait_max_s", &Run::wait_max, seconds({0.0})),
          output_only("min_clearance_m", &Run::min_clearance_m, nullable(number(kAnyNumber)),
                      "Smallest clearance that the monitor measured; null if no pair came close"),
          output_only("monitor_stops", &Run::monitor_stops, count()),
          output_only("evaluations", &Run::evaluations, count(),
                      "Number of state checks that the decisions of the policy took"),
          output_only("given_up", &Run::given_up, flag(),
                      "true if the simulation exceeded its limit of evaluations; the results then "
                      "cover only the time before"),
      }));
}

}  // namespace

FormatPtr<ComparisonView> comparison_format() {
  using View = ComparisonView;
  static const auto format = named(
      "Comparison", "Simulations of the same jobs under several policies.",
      object<View>({
          output_only("state", &View::state, choice<ComparisonState>()),
          output_only("jobs", &View::jobs, count(), "Number of compared jobs"),
          output_only("first_s", &View::first, cell_time(), "Submission time of the first job"),
          output_only("last_s", &View::last, cell_time(), "Submission time of the last job"),
          output_only("in_force", &View::in_force, text(),
                      "The server's policy when the comparison was requested"),
          output_only("policies", &View::policies, list(text()),
                      "Compared policies, in the order of `runs`"),
          output_only("runs", &View::runs, list(policy_run_format()), "Finished simulations"),
          output_only("detail", &View::detail, text(), "Reason of the failure; empty otherwise"),
      }));
  return format;
}

}  // namespace armloom
