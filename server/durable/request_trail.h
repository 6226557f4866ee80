#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "server/durable/job_keeper.h"
#include "server/http/message.h"
#include "server/log/log_line.h"
#include "server/store/stored_job.h"

namespace armloom {

// Writes changes and refusals to the audit trail, and requests to the log if wanted. Use on the
// server's thread.
class RequestTrail {
 public:
  // If `keeper` is null, there is no audit trail. It must outlive the callbacks that follow()
  // returns.
  RequestTrail(JobKeeper* keeper, Log log, LoggedRequests logged)
      : keeper_(keeper), log_(std::move(log)), logged_(logged) {}

  // Returns a callback that records the request, then responds. `who`: token name, or empty.
  [[nodiscard]] Respond follow(const Request& request, std::string who, Respond respond) const;

 private:
  void put_down(AuditEntry entry) const;
  void tell(const AuditEntry& entry, const std::string& id, bool only_looks,
            std::chrono::nanoseconds within) const;

  JobKeeper* keeper_;
  Log log_;
  LoggedRequests logged_;
};

}  // namespace armloom
