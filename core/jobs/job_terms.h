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

// How an arm gets to the start of a job's trajectory.
enum class MoveToStart {
  none,  // the arm must be there at the job's turn
  plan,  // an arm that is elsewhere at the job's turn is moved there first (ways/approach.h)
};
[[nodiscard]] constexpr const char* to_string(MoveToStart how) {
  switch (how) {
    case MoveToStart::none:
      return "none";
    case MoveToStart::plan:
      return "plan";
  }
  return nullptr;
}

// A job's terms: the settings of its request that decide when it runs. They stay with the job and
// are part of its published view. server/messages/job_terms.h describes them as JSON.
struct JobTerms {
  int priority = 0;  // larger goes first
  // Longest time in the backlog. nullopt: the cell's default; never nullopt in a scheduled Job.
  std::optional<Duration> backlog_timeout = {};
  OnTimeout on_timeout = OnTimeout::abort;
  MoveToStart move_to_start = MoveToStart::none;
  // The job may change places with other reorderable jobs of its arm that begin and end where it
  // does.
  bool reorderable = false;
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
