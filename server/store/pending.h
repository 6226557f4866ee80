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

namespace armloom {

// What of one job is to be written.
struct JobChange {
  std::optional<StoredJob> seen = {};
  std::optional<std::string> body = {};
  std::optional<RequestOrigin> origin = {};
  std::optional<std::string> amended = {};
  bool may_have_moved = false;
};

// What is to be noted, in the order in which it came. While nothing can be written the first ones
// of each kind are kept: what was refused, which anybody can bring about as often as they like,
// takes no place of what was done.
class PendingAudit {
 public:
  inline static constexpr std::size_t kMax = 10'000;  // of each kind; what comes beyond is not told

  void add(AuditEntry entry);
  [[nodiscard]] const std::vector<AuditEntry>& entries() const { return entries_; }

 private:
  std::vector<AuditEntry> entries_;
  std::size_t refusals_ = 0;  // of these
};

// What has come since the store was written last.
struct Pending {
  using Done = std::function<void(bool)>;
  std::map<std::uint64_t, JobChange> jobs = {};  // by number
  struct Stops {
    std::vector<std::string> arms;
    std::uint64_t number;  // by which StoreMark knows them
  };
  std::optional<Stops> stops = {};
  PendingAudit audit = {};
  std::vector<StoredAlert> alerts = {};              // as they came: of one alert the last counts
  std::map<std::string, StoredObject> objects = {};  // by name
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

  // While nothing can be written; what comes beyond is not told.
  inline static constexpr std::size_t kAlertsMax = 10'000;
  inline static constexpr std::size_t kAnswersMax = 10'000;

  [[nodiscard]] bool is_empty() const {
    return jobs.empty() && !stops && acceptances.empty() && audit.entries().empty() &&
           alerts.empty() && objects.empty() && answers.empty();
  }
  // What came after this.
  void join(Pending later);
};

// Jobs that were not accepted: their clients were told so, and nothing of them is ever written.
class GivenUpJobs {
 public:
  void add(const std::vector<std::uint64_t>& jobs) { jobs_.insert(jobs.begin(), jobs.end()); }
  // Takes out what is said of them. With its end the last word of a job is said.
  void pass_over(Pending& changes);

 private:
  std::set<std::uint64_t> jobs_;
};

}  // namespace armloom
