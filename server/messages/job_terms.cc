#include "server/messages/job_terms.h"

#include "server/codec/later_part.h"
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

}  // namespace

FormatPtr<JobOrder> job_order_format() { return choice<JobOrder>(); }

PartPtr<JobTerms> job_terms_part() {
  using Terms = JobTerms;
  return parts<Terms>({
      field("priority", &Terms::priority, priority_format(), "Larger goes first"),
      field("backlog_timeout_s", &Terms::backlog_timeout, backlog_timeout_format(),
            "How long it may wait in the backlog. Default: the cell's"),
      later(field("on_timeout", &Terms::on_timeout, choice<OnTimeout>(),
                  "What becomes of it then. \"replan\": another way is planned to where it ends, "
                  "from where its arm stands and past what rests there; it expires when there is "
                  "none, and after the third")),
      unless_usual("approach", &Terms::approach, Approach::none, choice<Approach>(),
                   "\"plan\": its arms need not stand where it begins; each that stands elsewhere "
                   "at its turn is brought there first, slowly, by a planned motion of the "
                   "server's own"),
      unless_usual("order", &Terms::order, JobOrder::as_given, job_order_format(),
                   "\"any\": jobs of one arm that begin and end at one place, and say so, may be "
                   "taken in another order"),
  });
}

PartPtr<AmendedTerms> amended_terms_part() {
  using Terms = AmendedTerms;
  return parts<Terms>({
      field("priority", &Terms::priority, priority_format(), "Larger goes first"),
      field("backlog_timeout_s", &Terms::backlog_timeout, backlog_timeout_format(),
            "Counts from when the job first was in conflict: it may be over at once"),
      field("on_timeout", &Terms::on_timeout, choice<OnTimeout>(), "What becomes of it then"),
  });
}

}  // namespace armloom
