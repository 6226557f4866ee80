#pragma once

#include <optional>
#include <string>

#include "core/base/time.h"
#include "core/model/io_description.h"

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
enum class MoveToStart {
  none,  // the arm must be there at the job's turn
  plan,  // the server moves it there at the job's turn (approach.h)
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

// A value that a signal must have.
struct SignalCondition {
  std::string signal;  // name
  SignalValue value;
};

// A client's terms for a job's turn. server/messages/job_terms.h defines the JSON.
struct JobTerms {
  int priority = 0;  // larger goes first
  // nullopt: the cell's value; always set in the scheduler's jobs.
  std::optional<Duration> backlog_timeout = {};
  OnTimeout on_timeout = OnTimeout::abort;
  MoveToStart move_to_start = MoveToStart::none;
  // The job may change places with another reorderable job of its arm. Both must begin and end at
  // the same position.
  bool reorderable = false;
  // The job does not start while the signal has another value, or an unknown one.
  std::optional<SignalCondition> start_when = {};
};

// The terms that can change while the job has not ended; nullopt: unchanged.
struct AmendedTerms {
  std::optional<int> priority = {};
  // Measured from the time at which the job entered the backlog, so a shorter timeout may be over
  // at once.
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
