#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/executive/executive.h"
#include "core/executive/signals.h"

namespace armloom {

// An external input that changes an executive, as recorded by InputLog. The cell, the options, the
// ticks and these inputs determine everything that the executive does. Arms in this process are
// simulated from a seed. The content of verdicts and plans follows from their questions, so only
// the times of their arrival are inputs.
struct ExecutiveInput {
  // A job as requested. Everything that is not here is read from `body`.
  struct AskedJob {
    std::vector<std::string> succeeded = {};       // JobRequest::known
    std::shared_ptr<const std::string> body = {};  // null if no log keeps it
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
  // The next chunk of the last opened batch was taken.
  struct WentOn {};
  struct FormerJob {
    JobId id{0};
    std::string key;
    TimePoint submitted_at;
    JobAmendment amended;  // the present values of all terms that can be amended
    AskedJob asked;
  };
  struct Restored {
    std::vector<FormerJob> jobs;
  };
  struct Canceled {
    std::string job;
  };
  struct RolledBack {
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
    StopCategory category = StopCategory::brake;
  };
  struct Resumed {
    std::vector<std::string> arms;
  };
  struct SpeedSet {
    std::string arm;  // the cell if empty
    double share;
  };
  struct PolicyChanged {
    std::string policy;
  };
  struct WoundDown {
    std::string cause;
    Executive::Waiting waiting;
  };
  using ObjectAdded = armloom::ObjectAdded;
  using ObjectReplaced = armloom::ObjectReplaced;
  using ObjectRemoved = armloom::ObjectRemoved;
  using ObjectsSet = armloom::ObjectsSet;
  using ObjectsExpired = armloom::ObjectsExpired;
  using ExpiryRestored = SceneExpiry;
  using ObjectHeld = HeldView;  // by an arm, when the server starts
  struct ObjectDetached {       // by a client, not by a step
    std::string object;
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
  // The answer to the scheduler's open question arrived. A replay compares `evaluations` to see
  // whether it gets the same answer.
  struct Judged {
    std::uint64_t evaluations;
    bool interrupted = false;  // Verdict::interrupted
  };
  // The answer to the guard's open question for certificates arrived.
  struct Certified {
    std::uint64_t evaluations;
  };
  // The answer to the open plan `question` of this step arrived.
  struct Planned {
    StepId step{JobId{0}};
    std::uint64_t question;
  };
  // The step's start is on disk (StartLog).
  struct StartWritten {
    StepId step{JobId{0}};
  };
  // A controller in another process reported its arm, or its connection changed. The next control
  // cycle takes it.
  struct Reported {
    std::string arm;
    ArmFeedback feedback;
  };
  struct Connected {
    std::string arm;
    ArmConnection connection;
  };
  struct SignalSet {
    std::string signal;
    SignalValue value;
  };
  // A device reported its signals.
  struct IoReported {
    IoReport report;
  };
  std::variant<Submitted, BatchOpened, AtomicBatchOpened, WentOn, Restored, Canceled, RolledBack,
               Held, Amended, Replanned, Stopped, Resumed, SpeedSet, PolicyChanged, WoundDown,
               ObjectAdded, ObjectReplaced, ObjectRemoved, ObjectsSet, ObjectsExpired,
               ExpiryRestored, ObjectHeld, ObjectDetached, Injected, FaultRemoved, Alerted, Judged,
               Certified, Planned, StartWritten, Reported, Connected, SignalSet, IoReported>
      what;
};

}  // namespace armloom
