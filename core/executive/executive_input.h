#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/executive/executive.h"

namespace armloom {

// What comes to an executive from outside and changes something, as InputLog has it. Beside its
// cell, its options and the ticks this is all that decides what it does: arms are simulated from a
// seed, and verdicts and plans follow from their questions; only when they come is an input.
struct ExecutiveInput {
  // A job as its client has it: all else of a request is read from its body.
  struct AskedJob {
    std::vector<std::string> succeeded = {};       // of JobRequest::known
    std::shared_ptr<const std::string> body = {};  // null: nobody keeps it
  };
  struct Submitted {
    std::vector<AskedJob> jobs;  // one
  };
  struct BatchOpened {
    std::vector<AskedJob> jobs;
  };
  struct AtomicBatchOpened {
    std::vector<AskedJob> jobs;
  };
  // One more part of the batch that was opened last was taken.
  struct WentOn {};
  struct FormerJob {
    JobId id{0};
    std::string key;
    TimePoint submitted_at;
    JobAmendment amended;  // all that can be, as it is by now
    AskedJob asked;
  };
  struct Restored {
    std::vector<FormerJob> jobs;
  };
  struct Canceled {
    std::string job;
  };
  struct Withdrawn {
    std::string job;
  };
  struct Held {
    std::string job;
    TimePoint until;
  };
  struct Amended {
    std::string job;
    JobAmendment amendment;
  };
  struct Replanned {
    std::string job;
  };
  struct Stopped {
    std::vector<std::string> arms;  // names
    std::string cause;
  };
  struct Resumed {
    std::vector<std::string> arms;
  };
  struct PolicyChanged {
    std::string policy;
  };
  struct WoundDown {
    std::string cause;
    Executive::Waiting waiting;
  };
  struct ObjectAdded {
    CollisionObject object;
  };
  struct ObjectReplaced {
    CollisionObject object;
  };
  struct ObjectRemoved {
    std::string name;
  };
  struct Injected {
    FaultRequest fault;
  };
  struct FaultRemoved {
    std::uint64_t fault;
  };
  struct Alerted {
    Alert alert;
  };
  // The answer to the one question of the scheduler that is open; `evaluations` tell whether a
  // replay comes to the same one.
  struct Judged {
    std::uint64_t evaluations;
    bool interrupted = false;  // Verdict::interrupted
  };
  // The answer to the guard's open question for certificates.
  struct Certified {
    std::uint64_t evaluations;
  };
  // The answer to the open question about this job's way.
  struct Planned {
    JobId job{0};
    std::uint64_t question;
  };
  // That this job may have moved is on disk (StartLog).
  struct StartWritten {
    JobId job{0};
  };
  std::variant<Submitted, BatchOpened, AtomicBatchOpened, WentOn, Restored, Canceled, Withdrawn,
               Held, Amended, Replanned, Stopped, Resumed, PolicyChanged, WoundDown, ObjectAdded,
               ObjectReplaced, ObjectRemoved, Injected, FaultRemoved, Alerted, Judged, Certified,
               Planned, StartWritten>
      what;
};

}  // namespace armloom
