#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/store/stored_alert.h"
#include "server/store/stored_job.h"

namespace armloom {

// What of one job is to be written.
struct JobChange {
  std::optional<StoredJob> seen = {};
  std::optional<std::string> body = {};
  std::optional<RequestOrigin> origin = {};
  std::optional<std::string> amended = {};
  bool may_have_moved = false;
};

// What has come since the store was written last.
struct Pending {
  using Done = std::function<void(bool)>;
  std::map<std::uint64_t, JobChange> jobs = {};  // by number
  std::optional<std::vector<std::string>> stopped_arms = {};
  std::vector<AuditEntry> audit = {};    // kAuditMax at most, the first ones
  std::vector<StoredAlert> alerts = {};  // as they came: of one alert the last counts
  struct Acceptance {
    std::vector<std::uint64_t> jobs;
    Done done;
  };
  std::vector<Acceptance> acceptances = {};
  std::vector<Done> starts = {};

  // While nothing can be written; what comes beyond is not told.
  inline static constexpr std::size_t kAuditMax = 10'000;
  inline static constexpr std::size_t kAlertsMax = 10'000;

  [[nodiscard]] bool is_empty() const {
    return jobs.empty() && !stopped_arms && acceptances.empty() && audit.empty() && alerts.empty();
  }
  // What came after this.
  void join(Pending later);
  // None of the acceptances will be: their jobs are taken out again, and their callers returned.
  [[nodiscard]] std::vector<Done> give_up_acceptances();
};

}  // namespace armloom
