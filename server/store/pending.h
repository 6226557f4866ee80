#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/store/stored_job.h"

namespace armloom {

// What of one job is to be written.
struct JobChange {
  std::optional<StoredJob> seen = {};
  std::optional<std::string> body = {};
  bool may_have_moved = false;
};

// What has come since the store was written last.
struct Pending {
  using Done = std::function<void(bool)>;
  std::map<std::uint64_t, JobChange> jobs = {};  // by number
  std::optional<std::vector<std::string>> stopped_arms = {};
  struct Acceptance {
    std::vector<std::uint64_t> jobs;
    Done done;
  };
  std::vector<Acceptance> acceptances = {};
  std::vector<Done> starts = {};

  [[nodiscard]] bool is_empty() const {
    return jobs.empty() && !stopped_arms && acceptances.empty();
  }
  // What came after this.
  void join(Pending later);
  // None of the acceptances will be: their jobs are taken out again, and their callers returned.
  [[nodiscard]] std::vector<Done> give_up_acceptances();
};

}  // namespace armloom
