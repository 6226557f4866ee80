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

// Caches the JSON of jobs until they change. Not thread-safe.
class JobTexts {
 public:
  [[nodiscard]] ListedJob of(const JobSheet::JobPtr& job, const WallClock& clock);
  [[nodiscard]] std::vector<ListedJob> of(const std::vector<JobSheet::JobPtr>& jobs,
                                          const WallClock& clock);
  // Drops the texts that no list has used since the previous call, if they are the majority.
  void end_list();

 private:
  struct Entry {
    JobSheet::JobPtr job;
    JobText text;
    std::uint64_t list = 0;  // last list that used the entry
  };
  std::unordered_map<std::uint64_t, Entry> entries_;  // by JobId
  std::uint64_t list_ = 1;
  std::size_t used_ = 0;  // entries used by the present list
};

// Writes long lists on a low-priority thread of its own.
class Listings {
 public:
  using Post = std::function<void(std::function<void()>)>;
  // `post` runs a task on the server's thread.
  explicit Listings(Post post);

  using Write = std::function<std::string(JobTexts&)>;
  // Calls then(text) on the server's thread.
  void write(Write write, std::function<void(std::string)> then);

 private:
  Post post_;
  JobTexts texts_;  // used only by the worker
  Worker worker_;   // last member: destroyed first
};

}  // namespace armloom
