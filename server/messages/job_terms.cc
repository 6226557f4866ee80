#include "server/messages/job_terms.h"

#include "server/codec/io_format.h"
#include "server/codec/later_part.h"
#include "server/codec/object_format.h"
#include "server/codec/part_groups.h"
#include "server/codec/scalar_formats.h"
#include "server/codec/value_formats.h"
#include "server/messages/time_max.h"

namespace armloom {

using namespace formats;

namespace {

constexpr int kPriorityMax = 1'000'000;

FormatPtr<int> priority_format() { return integer(-kPriorityMax, kPriorityMax); }
FormatPtr<Duration> backlog_timeout_format() { return seconds({0.0, kTimeMax_s}); }

FormatPtr<SignalCondition> signal_condition_format() {
  using Condition = SignalCondition;
  return object<Condition>({
      required("io", &Condition::signal, name(), "Name of the input or output"),
      required("value", &Condition::value, signal_value_format(), "Value at which the job starts"),
  });
}

}  // namespace

PartPtr<JobTerms> job_terms_part() {
  using Terms = JobTerms;
  return parts<Terms>({
      field("priority", &Terms::priority, priority_format(), "Priority; larger goes first"),
      field("backlog_timeout_s", &Terms::backlog_timeout, backlog_timeout_format(),
            "Longest time in the backlog; default: the cell's"),
      later(field("on_timeout", &Terms::on_timeout, choice<OnTimeout>(),
                  "Action on backlog timeout. `abort`: the job expires. `replan`: the server plans "
                  "another path from the arm's position to the job's end, around everything at "
                  "rest. The job expires if there is no such path, and after the third replan")),
      omit_default("move_to_start", &Terms::move_to_start, MoveToStart::none, choice<MoveToStart>(),
                   "`plan`: the arms need not be at the start of the trajectory. The server first "
                   "moves each arm there slowly, on a planned path"),
      omit_default("reorderable", &Terms::reorderable, false, flag(),
                   "true: the scheduler may reorder this job among reorderable jobs of the same "
                   "arm that begin and end at the same configuration"),
      field("start_when", &Terms::start_when, signal_condition_format(),
            "The job does not start while the signal has another value. It keeps its place in the "
            "queue of its arm"),
  });
}

PartPtr<AmendedTerms> amended_terms_part() {
  using Terms = AmendedTerms;
  return parts<Terms>({
      field("priority", &Terms::priority, priority_format(), "Priority; larger goes first"),
      field("backlog_timeout_s", &Terms::backlog_timeout, backlog_timeout_format(),
            "Longest time in the backlog, measured from the first conflict; a short timeout can "
            "end the job at once"),
      field("on_timeout", &Terms::on_timeout, choice<OnTimeout>(), "Action on backlog timeout"),
  });
}

}  // namespace armloom
