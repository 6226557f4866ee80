#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "server/durable/job_keeper.h"
#include "server/http/message.h"
#include "server/log/log_line.h"
#include "server/store/stored_job.h"

namespace armloom {

// Who did something, or was not let do it, is put down; and told in the log, where that is wanted.
// On the server's thread.
class RequestTrail {
 public:
  // `keeper`: null: nothing is kept; it outlives what was handed to follow().
  RequestTrail(JobKeeper* keeper, Log log, LoggedRequests logged)
      : keeper_(keeper), log_(std::move(log)), logged_(logged) {}

  // Hands the answer to `respond` when the request is put down. `who`: the token's name, or empty.
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
