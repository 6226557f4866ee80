#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "core/executive/events.h"

namespace armloom {

// Returns the queue list for jobs of this state; null if the job has ended. A paused job is in the
// list `running`.
[[nodiscard]] std::vector<std::string> QueueView::*queue_list_of(JobState state);

// Keeps the four queue lists, in order of job ids. They are made from the published job states, so
// lists and jobs always agree.
class QueueLists {
 public:
  void put(const JobView& job);
  // Returns the view with the four lists. The caller fills in its other members.
  [[nodiscard]] const QueueView& view() const { return view_; }
  [[nodiscard]] QueueView& view() { return view_; }

 private:
  using List = std::vector<std::string> QueueView::*;
  [[nodiscard]] std::vector<JobId>& ids(List list);

  QueueView view_;
  std::array<std::vector<JobId>, 4> ids_;  // of the four lists, ascending
  std::unordered_map<JobId, List> stands_in_;
};

}  // namespace armloom
