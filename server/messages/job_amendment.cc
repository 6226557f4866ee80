#include "server/messages/job_amendment.h"

#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_request.h"

namespace armloom {

using namespace formats;

FormatPtr<JobAmendment> job_amendment_format() {
  using Amendment = JobAmendment;
  static const auto format =
      named("JobAmendment", "What is to be changed; what is absent stays.",
            object<Amendment>({
                field("name", &Amendment::name, job_name_format(), "For people"),
                field("priority", &Amendment::priority, priority_format(), "Larger goes first"),
                field("backlog_timeout_s", &Amendment::backlog_timeout, backlog_timeout_format(),
                      "Counts from when the job first was in conflict: it may be over at once"),
                field("on_timeout", &Amendment::on_timeout, on_timeout_format(),
                      "What becomes of it then"),
            }));
  return format;
}

Result<JobAmendment> read_job_amendment(std::string_view text) {
  return read_text(*job_amendment_format(), text);
}

JobAmendment amendable_of(const JobView& job) {
  return {job.name, job.terms.priority, job.terms.backlog_timeout,
          job.terms.replans_on_timeout ? OnTimeout::replan : OnTimeout::abort};
}

void apply(const JobAmendment& amendment, JobRequest& request) {
  if (amendment.name) request.name = *amendment.name;
  if (amendment.priority) request.terms.priority = *amendment.priority;
  if (amendment.backlog_timeout) request.terms.backlog_timeout = amendment.backlog_timeout;
  if (amendment.on_timeout) request.terms.on_timeout = *amendment.on_timeout;
}

}  // namespace armloom
