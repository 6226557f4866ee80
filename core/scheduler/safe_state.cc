#include "core/scheduler/safe_state.h"

#include <algorithm>
#include <set>

namespace armloom {
namespace {

class Search {
 public:
  Search(const std::vector<WaitingWork>& waiting, const std::vector<RestInTheWay>& rests)
      : waiting_(waiting), rests_(rests) {}

  bool run(std::vector<bool> done) {
    if (std::ranges::find(done, false) == done.end()) return true;
    if (seen_.size() >= kStatesMax || !seen_.insert(done).second) return false;
    for (std::size_t j = 0; j < waiting_.size(); ++j) {
      if (done[j] || !is_next(j, done) || !is_free(j, done)) continue;
      done[j] = true;
      order.push_back(waiting_[j].job);
      if (run(done)) return true;
      order.pop_back();
      done[j] = false;
    }
    return false;
  }

  std::vector<JobId> order;

 private:
  [[nodiscard]] bool share_an_arm(std::size_t a, std::size_t b) const {
    return std::ranges::any_of(waiting_[a].arms, [&](ArmId arm) {
      return std::ranges::find(waiting_[b].arms, arm) != waiting_[b].arms.end();
    });
  }

  [[nodiscard]] bool is_next(std::size_t job, const std::vector<bool>& done) const {
    for (std::size_t before = 0; before < job; ++before) {
      if (!done[before] && share_an_arm(before, job)) return false;
    }
    return true;
  }

  // The last one done of an arm says where it rests.
  [[nodiscard]] bool is_free(std::size_t job, const std::vector<bool>& done) const {
    return std::ranges::none_of(rests_, [&](const RestInTheWay& rest) {
      if (rest.job != waiting_[job].job) return false;
      std::optional<JobId> last;
      for (std::size_t j = 0; j < waiting_.size(); ++j) {
        const auto& arms = waiting_[j].arms;
        if (done[j] && std::ranges::find(arms, rest.arm) != arms.end()) last = waiting_[j].job;
      }
      return last == rest.after;
    });
  }

  const std::vector<WaitingWork>& waiting_;
  const std::vector<RestInTheWay>& rests_;
  std::set<std::vector<bool>> seen_;
};

}  // namespace

std::optional<std::vector<JobId>> order_of_work(const std::vector<WaitingWork>& waiting,
                                                const std::vector<RestInTheWay>& rests,
                                                const std::vector<JobId>& done) {
  std::vector<bool> begun(waiting.size(), false);
  for (std::size_t j = 0; j < waiting.size(); ++j) {
    begun[j] = std::ranges::find(done, waiting[j].job) != done.end();
  }
  Search search(waiting, rests);
  if (!search.run(std::move(begun))) return std::nullopt;
  return std::move(search.order);
}

}  // namespace armloom
