#include "server/messages/comparison.h"

#include <algorithm>

#include "core/executive/known_policies.h"
#include "server/codec/list_formats.h"
#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/told_part.h"
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
              "To run the jobs under, in this order; none: all"),
          field("since_s", &Inquiry::since, cell_time(),
                "Only jobs that were submitted at this cell time or later"),
          field("seed", &Inquiry::seed, count(), "Of the simulated arms: the same one repeats it"),
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
                           "policy \"" + *name + "\" is named twice", *name});
  }
  return inquiry;
}

namespace {

FormatPtr<PolicyRun> policy_run_format() {
  using Run = PolicyRun;
  return named(
      "PolicyRun", "What would have become of the jobs under this policy: simulated.",
      object<Run>({
          told("policy", &Run::policy, text()),
          told("succeeded", &Run::succeeded, count()),
          told("expired", &Run::expired, count()),
          told("failed", &Run::failed, count()),
          told("canceled", &Run::canceled, count(), "By the server: interrupted ones, too"),
          told("refused", &Run::refused, count(),
               "When they came: they would not have begun where their arm would have stood"),
          told("unfinished", &Run::unfinished, count(),
               "When nothing could happen any more, or the run was given up"),
          told("backlogged", &Run::backlogged, count(), "Waited in the backlog, at least once"),
          told("makespan_s", &Run::makespan, nullable(seconds({0.0})),
               "From the first submission to the last end; null: not all ended, or none started"),
          told("makespan_ratio", &Run::makespan_ratio, nullable(number({0.0})),
               "makespan_s, divided by that of `sequential`; null: not known"),
          told("wait_mean_s", &Run::wait_mean, seconds({0.0}), "From submission to start"),
          told("wait_max_s", &Run::wait_max, seconds({0.0})),
          told("min_clearance_m", &Run::min_clearance_m, nullable(number(kAnyNumber)),
               "The smallest that the monitor saw; null: never near"),
          told("monitor_stops", &Run::monitor_stops, count()),
          told("evaluations", &Run::evaluations, count(), "Combined states looked at to decide"),
          told("given_up", &Run::given_up, flag(),
               "It took more evaluations than one run may: figures are of what was done by then"),
      }));
}

}  // namespace

FormatPtr<ComparisonView> comparison_format() {
  using View = ComparisonView;
  static const auto format =
      named("Comparison", "The same jobs under several policies, in simulation.",
            object<View>({
                told("state", &View::state, choice<ComparisonState>()),
                told("jobs", &View::jobs, count(), "That are compared"),
                told("first_s", &View::first, cell_time(), "When the first of them was submitted"),
                told("last_s", &View::last, cell_time(), "And the last"),
                told("in_force", &View::in_force, text(),
                     "The policy, when the comparison was asked for"),
                told("policies", &View::policies, list(text()), "In the order of the runs"),
                told("runs", &View::runs, list(policy_run_format()), "Those that are done"),
                told("detail", &View::detail, text(), "Why it failed; else empty"),
            }));
  return format;
}

}  // namespace armloom
