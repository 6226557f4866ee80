#pragma once

#include <optional>

#include "core/base/time.h"

namespace armloom {

// Handling of a job whose backlog timeout is over.
enum class OnTimeout {
  abort,   // it expires
  replan,  // it is replanned before it expires (replanning.h)
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

// How an arm gets to a job's start.
enum class Approach {
  none,  // the arm must be there at the job's turn
  plan,  // the server moves it there at the job's turn (approach.h)
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

// `any`: jobs of one arm with equal start and end may change places if all of them are `any`.
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

// A client's terms for a job's turn. server/messages/job_terms.h defines the JSON.
struct JobTerms {
  int priority = 0;  // larger goes first
  // nullopt: the cell's value; always set in the scheduler's jobs.
  std::optional<Duration> backlog_timeout = {};
  OnTimeout on_timeout = OnTimeout::abort;
  Approach approach = Approach::none;
  JobOrder order = JobOrder::as_given;
};

// The terms that can change while the job has not ended; nullopt: unchanged.
struct AmendedTerms {
  std::optional<int> priority = {};
  // Measured from the time of the first conflict, so it may be over at once.
  std::optional<Duration> backlog_timeout = {};
  std::optional<OnTimeout> on_timeout = {};
};

inline void apply(const AmendedTerms& amended, JobTerms& terms) {
  if (amended.priority) terms.priority = *amended.priority;
  if (amended.backlog_timeout) terms.backlog_timeout = amended.backlog_timeout;
  if (amended.on_timeout) terms.on_timeout = *amended.on_timeout;
}
[[nodiscard]] inline AmendedTerms amendable(const JobTerms& terms) {
  return {terms.priority, terms.backlog_timeout, terms.on_timeout};
}

}  // namespace armloom
