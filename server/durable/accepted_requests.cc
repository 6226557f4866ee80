#include "server/durable/accepted_requests.h"

#include <algorithm>
#include <iterator>

namespace armloom {

bool AcceptedRequests::begin(const Names& names, std::function<void()> again) {
  for (const std::string& name : names) {
    const auto taken = under_way_.find(name);
    if (taken == under_way_.end()) continue;
    taken->second.push_back(std::move(again));
    return false;
  }
  for (const std::string& name : names) under_way_.try_emplace(name);
  return true;
}

void AcceptedRequests::end(const Names& names) {
  std::vector<std::function<void()>> waiting;
  for (const std::string& name : names) {
    auto node = under_way_.extract(name);
    if (!node.empty()) std::ranges::move(node.mapped(), std::back_inserter(waiting));
  }
  for (const auto& again : waiting) again();
}

void AcceptedRequests::remember(const std::string& name, Accepted accepted) {
  const auto [known, is_new] = accepted_.try_emplace(name, std::move(accepted));
  if (!is_new) {
    if (known->second.digest == accepted.digest) return known->second.jobs.merge(accepted.jobs);
    known->second = std::move(accepted);
    return;
  }
  in_order_.push_back(name);
  if (in_order_.size() <= kept_max_) return;
  accepted_.erase(in_order_.front());
  in_order_.pop_front();
}

const AcceptedRequests::Accepted* AcceptedRequests::find(const std::string& name) const {
  const auto it = accepted_.find(name);
  return it == accepted_.end() ? nullptr : &it->second;
}

}  // namespace armloom
