#pragma once

#include <optional>

#include "core/base/time.h"

namespace armloom {

// What becomes of a job when its time in the backlog is over.
enum class OnTimeout {
  abort,   // it expires
  replan,  // it is planned anew, before it expires (replanning.h)
};
[[nodiscard]] constexpr const char* to_string(OnTimeout what) {
  switch (what) {
    case OnTimeout::abort:
      return "abort";
    case OnTimeout::replan:
      return "replan";
  }
  return nullptr;
}

// How an arm comes to where a job begins.
enum class Approach {
  none,  // it stands there by then
  plan,  // one that stands elsewhere at the job's turn is brought there first (approach.h)
};
[[nodiscard]] constexpr const char* to_string(Approach how) {
  switch (how) {
    case Approach::none:
      return "none";
    case Approach::plan:
      return "plan";
  }
  return nullptr;
}

// Whether jobs of one arm that begin and end at one place have to run in the order in which they
// came. They may change places with each other where each of them says `any`.
enum class JobOrder { as_given, any };
[[nodiscard]] constexpr const char* to_string(JobOrder order) {
  switch (order) {
    case JobOrder::as_given:
      return "as_given";
    case JobOrder::any:
      return "any";
  }
  return nullptr;
}

// What a job's turn goes by, as its client asks for it: it stands in the request, stays with the
// job, and is told of it. server/messages/job_terms.h says how each of these is written.
struct JobTerms {
  int priority = 0;  // larger goes first
  // In the backlog. Absent: the cell's; of a job of the scheduler it is never absent.
  std::optional<Duration> backlog_timeout = {};
  OnTimeout on_timeout = OnTimeout::abort;
  Approach approach = Approach::none;
  JobOrder order = JobOrder::as_given;
};

// Of these, what can still be changed while the job has not ended; what is absent stays.
struct AmendedTerms {
  std::optional<int> priority = {};
  // It counts from when the job first was in conflict: it may be over at once.
  std::optional<Duration> backlog_timeout = {};
  std::optional<OnTimeout> on_timeout = {};
};

inline void apply(const AmendedTerms& amended, JobTerms& terms) {
  if (amended.priority) terms.priority = *amended.priority;
  if (amended.backlog_timeout) terms.backlog_timeout = amended.backlog_timeout;
  if (amended.on_timeout) terms.on_timeout = *amended.on_timeout;
}
// As they are.
[[nodiscard]] inline AmendedTerms amendable(const JobTerms& terms) {
  return {terms.priority, terms.backlog_timeout, terms.on_timeout};
}

}  // namespace armloom
