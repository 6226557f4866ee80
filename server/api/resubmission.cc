#include "server/api/resubmission.h"

#include <algorithm>
#include <optional>

#include "core/executive/status_board.h"

namespace armloom {
namespace {

constexpr std::size_t kKeyMax = 255;
constexpr char kNameEnds = '\x1f';  // separates the token's name from the key; occurs in neither

AcceptedRequests::Names names_of(const SentRequest& sent) {
  AcceptedRequests::Names names;
  if (!sent.key.empty()) names.push_back(AcceptedRequests::name_of_key(sent.key));
  for (const SentRequest::Job& job : sent.jobs) {
    if (!job.id.empty()) names.push_back(AcceptedRequests::name_of_id(job.id));
  }
  return names;
}

Problem other_body(const std::string& key) {
  return {ProblemKind::conflict, "idempotency-key-in-use", "Idempotency-Key",
          "this Idempotency-Key was already used with a different body: use a new key",
          key.substr(key.find(kNameEnds) + 1)};  // the whole key if no token is required
}

// Finds the jobs that were accepted with this Idempotency-Key. Problem (conflict): the key was used
// with another body.
Result<void> recall_key(const ApiParts& parts, const SentRequest& sent, KnownJobs& known) {
  if (sent.key.empty()) return {};
  const auto put = [&](std::size_t place, const std::string& id) {
    if (place < known.size()) known[place] = id;
  };
  if (const auto* before = parts.accepted->find(AcceptedRequests::name_of_key(sent.key))) {
    if (before->digest != sent.digest) return failure(other_body(sent.key));
    for (const auto& [place, id] : before->jobs) put(place, id);
  }
  if (parts.keeper == nullptr) return {};
  const auto stored = parts.keeper->history().of_request(sent.key);
  if (!stored) return failure(stored.error());
  for (const StoredJob& job : *stored) {
    if (job.origin.key_digest != sent.digest) return failure(other_body(sent.key));
    put(job.origin.place, job.id);
  }
  return {};
}

// Finds the job that was accepted with this id and this body. If the id had another body, submit()
// refuses the job later.
Result<void> recall_id(const ApiParts& parts, const SentRequest::Job& job, std::string& known) {
  if (job.id.empty() || !known.empty()) return {};
  if (const auto* before = parts.accepted->find(AcceptedRequests::name_of_id(job.id))) {
    if (before->digest == job.digest) known = job.id;
    return {};
  }
  if (parts.keeper == nullptr) return {};
  const auto stored = parts.keeper->history().find(job.id);
  if (!stored) return failure(stored.error());
  if (*stored && (*stored)->origin.digest == job.digest) known = job.id;
  return {};
}

Result<KnownJobs> known_of(const ApiParts& parts, const SentRequest& sent) {
  KnownJobs known(sent.jobs.size());
  if (auto found = recall_key(parts, sent, known); !found) return failure(found.error());
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (auto found = recall_id(parts, sent.jobs[i], known[i]); !found) {
      return failure(found.error());
    }
  }
  return known;
}

Problem forgotten(const std::string& id) {
  return {
      ProblemKind::conflict, "job-forgotten", "",
      "already accepted as job \"" + id +
          "\", which ended and was forgotten; it is not run again. Use a new id to run it again",
      id};
}

Result<ListedJob> stored_or_forgotten(const ApiParts& parts, const std::string& id) {
  if (parts.keeper == nullptr) return failure(forgotten(id));
  auto stored = parts.keeper->history().find(id);
  if (!stored) return failure(stored.error());
  if (!*stored) return failure(forgotten(id));
  return ListedJob(std::make_shared<const std::string>(std::move((*stored)->view)));
}

}  // namespace

Parameter idempotency_parameter() {
  return {"Idempotency-Key",
          "Client-chosen name of the request. A repeated request with the same key and body "
          "returns the same jobs; with `--data`, also after a restart. The same key with another "
          "body is answered 409",
          {{"type", "string"}, {"minLength", 1}, {"maxLength", kKeyMax}},
          false,
          "header"};
}

Result<std::string> idempotency_key(const ApiParts& parts, const Request& request) {
  if (!request.idempotency_key) return std::string();
  const std::string& key = *request.idempotency_key;
  const bool printable = std::ranges::all_of(key, [](char c) { return c >= ' ' && c <= '~'; });
  if (!key.empty() && key.size() <= kKeyMax && printable) {
    const auto who = parts.guard.asks() ? parts.guard.caller(request.token) : std::nullopt;
    return who ? who->name + kNameEnds + key : key;
  }
  return failure(Problem{ProblemKind::malformed, "bad-idempotency-key", "Idempotency-Key",
                         "an Idempotency-Key must have 1 to 255 printable ASCII characters",
                         key.substr(0, kKeyMax)});
}

void recall(const ApiParts& parts, const SentRequestPtr& sent, Respond respond,
            std::function<void(const KnownJobs&, const Respond&)> then) {
  const auto names = names_of(*sent);
  const bool is_first = parts.accepted->begin(
      names, [&parts, sent, respond, then] { recall(parts, sent, respond, then); });
  if (!is_first) return;
  const Respond ending = [&parts, names, respond = std::move(respond)](Response response) {
    respond(std::move(response));
    parts.accepted->end(names);
  };
  const auto known = known_of(parts, *sent);
  if (!known) return ending(problem_response(known.error()));
  then(*known, ending);
}

void note_accepted(const ApiParts& parts, const SentRequest& sent, const KnownJobs& accepted) {
  if (parts.keeper != nullptr) return;  // the store remembers the jobs
  AcceptedRequests::Accepted by_key{sent.digest, {}};
  for (std::size_t i = 0; i < accepted.size(); ++i) {
    if (accepted[i].empty()) continue;
    by_key.jobs.emplace(i, accepted[i]);
    if (!sent.jobs[i].id.empty()) {
      parts.accepted->remember(AcceptedRequests::name_of_id(accepted[i]),
                               {sent.jobs[i].digest, {{0, accepted[i]}}});
    }
  }
  if (sent.key.empty() || by_key.jobs.empty()) return;
  parts.accepted->remember(AcceptedRequests::name_of_key(sent.key), std::move(by_key));
}

void note_answered(const ApiParts& parts, const SentRequest& sent, const KnownJobs& known) {
  if (sent.key.empty()) return;
  const std::string name = AcceptedRequests::name_of_key(sent.key);
  for (std::size_t i = 0; i < known.size(); ++i) {
    const auto* before = parts.accepted->find(name);
    if (known[i].empty() || (before != nullptr && before->jobs.contains(i))) continue;
    parts.accepted->remember(name, {sent.digest, {{i, known[i]}}});
    if (parts.keeper == nullptr) continue;
    const auto stored = parts.keeper->history().find(known[i]);
    if (!stored || !*stored || (*stored)->origin.key == sent.key) continue;
    parts.keeper->store().answered_with((*stored)->number, origin_of(sent, i));
  }
}

RequestOrigin origin_of(const SentRequest& sent, std::size_t place) {
  return {sent.jobs[place].digest, sent.key, sent.digest, place};
}

void acknowledge(const ApiParts& parts, std::vector<JobKeeper::AcceptedJob> jobs,
                 const Respond& respond, std::function<Response()> answer) {
  std::vector<JobsAtHand::Job> submitted;
  submitted.reserve(jobs.size());
  for (const auto& accepted : jobs) {
    submitted.push_back({accepted.job.key, accepted.job.times.submitted_at,
                         std::make_shared<const std::string>(accepted.body)});
  }
  const auto accept = [&parts, submitted = std::move(submitted), respond,
                       answer = std::move(answer)] {
    for (const JobsAtHand::Job& job : submitted) {
      parts.at_hand->note(job);
      if (parts.recording != nullptr) parts.recording->job(job.submitted_at, *job.body);
    }
    respond(answer());
  };
  if (parts.keeper == nullptr || jobs.empty()) return accept();
  parts.keeper->accept(std::move(jobs), [respond, accept](const std::optional<Refusal>& refusal) {
    refusal ? respond(refusal_response(*refusal)) : accept();
  });
}

void look_at(const ApiParts& parts, const KnownJobs& ids,
             std::function<void(std::vector<Result<ListedJob>>)> then) {
  KnownJobs asked = ids;
  std::erase(asked, "");
  if (asked.empty()) return then({});
  const auto jobs = parts.loop.board().jobs(asked);
  std::vector<Result<ListedJob>> found;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    found.push_back(jobs[i] ? Result<ListedJob>(ListedJob(*jobs[i]))
                            : stored_or_forgotten(parts, asked[i]));
  }
  then(std::move(found));
}

}  // namespace armloom
