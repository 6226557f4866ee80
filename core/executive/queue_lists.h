#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "core/executive/events.h"

namespace armloom {

// The list of the queue in which a job of this state stands; null once it has ended. A job at rest
// on its path (`paused`) counts as running.
[[nodiscard]] std::vector<std::string> QueueView::*queue_list_of(JobState state);

// Which job stands in which list of the queue, in order of submission. Takes the state that clients
// are told with the job, so that both always agree.
class QueueLists {
 public:
  void put(const JobView& job);
  // The four lists; the caller fills in the rest.
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
