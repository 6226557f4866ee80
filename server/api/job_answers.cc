#include "server/api/job_answers.h"

#include <string_view>
#include <utility>

#include "server/http/entity_tag.h"
#include "server/messages/job_amendment.h"

namespace armloom {
namespace {

std::string changeable_tag(const JobView& job) {
  return tag_of(text_of(*job_amendment_format(), amendable_of(job)));
}

Response tagged(Response response, const std::string& first_part) {
  response.headers.emplace_back("ETag", '"' + first_part + '.' + tag_of(response.body) + '"');
  return response;
}

}  // namespace

Result<std::optional<StoredJob>> stored_job(const ApiParts& parts, const std::string& key) {
  if (parts.keeper == nullptr) return std::nullopt;
  return parts.keeper->history().find(key);
}

Response job_answer(int status, const JobView& job, const WallClock& clock) {
  return tagged(answer(status, job_format(), job, &clock), changeable_tag(job));
}

Response job_answer(const StoredJob& job) { return tagged(json_response(200, job.view), "ended"); }

bool is_as_tagged(const IfMatch& if_match, const std::optional<JobView>& job) {
  if (!if_match || !job || is_terminal(job->state)) return true;
  const std::string mine = '"' + changeable_tag(*job) + '.';
  return any_tag(*if_match,
                 [&](std::string_view tag) { return tag == "*" || tag.starts_with(mine); });
}

std::optional<Response> bad_if_match(const Request& request) {
  const IfMatch& asked = request.if_match;
  if (!asked || is_tag_list(*asked)) return std::nullopt;
  return refusal_response({400, "bad-if-match",
                           "If-Match must be \"*\" or a list of entity tags in quotes", "If-Match",
                           asked});
}

Parameter if_match_parameter() {
  return {"If-Match",
          "`ETag` of the job as the client read it; 412 if the job was changed since",
          {{"type", "string"}},
          false,
          "header"};
}

Response was_changed_since(const std::string& key, const IfMatch& if_match) {
  return refusal_response(
      {412, "precondition-failed",
       "job \"" + key + "\" has changed since the ETag in If-Match; fetch it again", "If-Match",
       if_match});
}

Response refused_command(const ApiParts& parts, const std::string& key, const Problems& problems) {
  const auto stored = stored_job(parts, key);
  const bool ended_before =
      stored && *stored && (*stored)->has_ended && problems.front().kind == ProblemKind::not_found;
  if (!ended_before && problems.front().slug == "no-such-job") return no_such_job(parts, key);
  if (!ended_before) return problem_response(problems);
  return problem_response({Problem{ProblemKind::conflict, "job-has-ended", "",
                                   "job \"" + key + "\" has ended: " + (*stored)->state, key}});
}

}  // namespace armloom
