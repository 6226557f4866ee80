#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace armloom {

// Requests for jobs, which clients send again when no answer came. A request has names: its
// Idempotency-Key, and the ids that the client gave its jobs. Knows those that are being answered;
// and those that were accepted, where no store does, as many as `kept_max`. On the server's thread.
class AcceptedRequests {
 public:
  using Names = std::vector<std::string>;
  [[nodiscard]] static std::string name_of_key(const std::string& key) { return "key " + key; }
  [[nodiscard]] static std::string name_of_id(const std::string& id) { return "id " + id; }

  explicit AcceptedRequests(std::size_t kept_max = 20'000) : kept_max_(kept_max) {}

  // From now on a request of these names is being answered, until end(). False: one of these names
  // is taken by another one; `again` is called when that one was answered.
  [[nodiscard]] bool begin(const Names& names, std::function<void()> again);
  void end(const Names& names);

  struct Accepted {
    std::string digest;                       // of the body
    std::map<std::size_t, std::string> jobs;  // ids, by their places in the request
  };
  // Beside what else was accepted of the same request.
  void remember(const std::string& name, Accepted accepted);
  [[nodiscard]] const Accepted* find(const std::string& name) const;

 private:
  std::size_t kept_max_;
  std::unordered_map<std::string, std::vector<std::function<void()>>> under_way_;  // who waits
  std::unordered_map<std::string, Accepted> accepted_;
  std::deque<std::string> in_order_;  // of accepted_
};

}  // namespace armloom
