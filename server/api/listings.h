#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/executive/job_sheet.h"
#include "core/executive/worker.h"
#include "server/codec/wall_clock.h"
#include "server/messages/job.h"

namespace armloom {

// The JSON of jobs, written once for each change of a job. Not thread-safe.
class JobTexts {
 public:
  [[nodiscard]] ListedJob of(const JobSheet::JobPtr& job, const WallClock& clock);
  [[nodiscard]] std::vector<ListedJob> of(const std::vector<JobSheet::JobPtr>& jobs,
                                          const WallClock& clock);
  // Forgets texts that no list has used since the call before, if they are the larger part.
  void end_list();

 private:
  struct Entry {
    JobSheet::JobPtr job;
    JobText text;
    std::uint64_t list = 0;  // the last one that used it
  };
  std::unordered_map<std::uint64_t, Entry> entries_;  // by JobId
  std::uint64_t list_ = 1;
  std::size_t used_ = 0;  // entries, by this list
};

// A thread that writes long lists of jobs, so that neither the strand nor the server's thread does.
// It gives way to both.
class Listings {
 public:
  using Post = std::function<void(std::function<void()>)>;
  // `post` hands a task to the server's thread.
  explicit Listings(Post post);

  using Write = std::function<std::string(JobTexts&)>;
  // Calls then(text) on the server's thread.
  void write(Write write, std::function<void(std::string)> then);

 private:
  Post post_;
  JobTexts texts_;  // the worker's
  Worker worker_;   // the last: it ends first
};

}  // namespace armloom
