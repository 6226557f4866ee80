#include "core/scheduler/waiting/priority_inheritance.h"

#include <algorithm>

namespace armloom {

// From the most urgent job downwards, each lends its priority to all that it waits for and that
// nobody more urgent has reached.
std::map<JobId, int> effective_priorities(const WaitsFor& graph, std::vector<Urgency> jobs) {
  std::ranges::stable_sort(jobs, std::ranges::greater{}, &Urgency::priority);
  std::map<JobId, int> effective;
  for (const Urgency& urgency : jobs) effective[urgency.job] = urgency.priority;
  std::vector<bool> reached(graph.nodes().size(), false);
  std::vector<std::size_t> open;
  for (const Urgency& urgency : jobs) {
    const std::size_t start = graph.index_of(urgency.job);
    if (start == graph.nodes().size() || reached[start]) continue;
    reached[start] = true;
    open.push_back(start);
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      if (const auto* job = std::get_if<JobId>(&graph.nodes()[node])) {
        const auto it = effective.find(*job);
        if (it != effective.end()) it->second = std::max(it->second, urgency.priority);
      }
      for (std::size_t first : graph.first_of(node)) {
        if (reached[first]) continue;
        reached[first] = true;
        open.push_back(first);
      }
    }
  }
  return effective;
}

}  // namespace armloom
