#include "server/messages/job_amendment.h"

#include "server/codec/object_format.h"
#include "server/codec/read_text.h"
#include "server/codec/value_formats.h"
#include "server/messages/job_request.h"
#include "server/messages/job_terms.h"

namespace armloom {

using namespace formats;

FormatPtr<JobAmendment> job_amendment_format() {
  using Amendment = JobAmendment;
  static const auto format =
      named("JobAmendment", "Members to change; absent members keep their values.",
            object<Amendment>({
                field("name", &Amendment::name, job_name_format(), "Display name"),
                inlined(&Amendment::terms, amended_terms_part()),
            }));
  return format;
}

Result<JobAmendment> read_job_amendment(std::string_view text) {
  return read_text(*job_amendment_format(), text);
}

JobAmendment amendable_of(const JobView& job) { return {job.name, amendable(job.terms)}; }

void apply(const JobAmendment& amendment, JobRequest& request) {
  if (amendment.name) request.name = *amendment.name;
  apply(amendment.terms, request.terms);
}

}  // namespace armloom
