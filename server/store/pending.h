#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/store/stored_alert.h"
#include "server/store/stored_job.h"
#include "server/store/stored_object.h"
#include "server/store/stored_speed.h"

namespace armloom {

// Unwritten changes of one job.
struct JobChange {
  std::optional<StoredJob> seen = {};
  std::optional<std::string> body = {};
  std::optional<RequestOrigin> origin = {};
  std::optional<std::string> amended = {};
  bool may_have_moved = false;
};

// Unwritten audit entries, in order. Keeps the first kMax changes and the first kMax refusals. So
// refusals, which any client can cause, do not displace changes.
class PendingAudit {
 public:
  inline static constexpr std::size_t kMax = 10'000;  // of each kind; later entries are dropped

  void add(AuditEntry entry);
  [[nodiscard]] const std::vector<AuditEntry>& entries() const { return entries_; }

 private:
  std::vector<AuditEntry> entries_;
  std::size_t refusals_ = 0;  // number of refusals in entries_
};

// Unwritten changes: all changes since the last write.
struct Pending {
  using Done = std::function<void(bool)>;
  std::map<std::uint64_t, JobChange> jobs = {};  // by number
  struct Stops {
    std::vector<std::string> arms;
    std::uint64_t number;  // for StoreMark
  };
  std::optional<Stops> stops = {};
  PendingAudit audit = {};
  std::vector<StoredAlert> alerts = {};              // in order; an alert's last state applies
  std::map<std::string, StoredObject> objects = {};  // by name
  std::map<std::string, StoredSpeed> speeds = {};    // by arm
  struct Answer {
    std::uint64_t job;
    RequestOrigin request;
  };
  std::vector<Answer> answers = {};
  struct Acceptance {
    std::vector<std::uint64_t> jobs;
    Done done;
  };
  std::vector<Acceptance> acceptances = {};
  struct Start {
    std::uint64_t job;
    Done done;
  };
  std::vector<Start> starts = {};

  // Limits while writing fails; later entries are dropped.
  inline static constexpr std::size_t kAlertsMax = 10'000;
  inline static constexpr std::size_t kAnswersMax = 10'000;

  [[nodiscard]] bool is_empty() const {
    return jobs.empty() && !stops && acceptances.empty() && audit.entries().empty() &&
           alerts.empty() && objects.empty() && speeds.empty() && answers.empty();
  }
  // Adds later changes.
  void join(Pending later);
};

// Jobs that could not be stored. Their clients were told so, and none of their changes is ever
// written.
class GivenUpJobs {
 public:
  void add(const std::vector<std::uint64_t>& jobs) { jobs_.insert(jobs.begin(), jobs.end()); }
  // Removes the changes of these jobs. Forgets a job after the change that ends it, because no
  // change follows.
  void pass_over(Pending& changes);

 private:
  std::set<std::uint64_t> jobs_;
};

}  // namespace armloom
