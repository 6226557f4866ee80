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

// Requests for jobs, which clients may repeat. A request's names are its Idempotency-Key and its
// client-given job ids. Remembers the requests in progress and, if the server has no store, the
// accepted requests (the last `kept_max` names). Use on the server's thread.
class AcceptedRequests {
 public:
  using Names = std::vector<std::string>;
  [[nodiscard]] static std::string name_of_key(const std::string& key) { return "key " + key; }
  [[nodiscard]] static std::string name_of_id(const std::string& id) { return "id " + id; }

  explicit AcceptedRequests(std::size_t kept_max = 20'000) : kept_max_(kept_max) {}

  // Registers a request in progress, until end(). Returns false if another request in progress has
  // one of its names. `again` is then called when the other request has been answered.
  [[nodiscard]] bool begin(const Names& names, std::function<void()> again);
  void end(const Names& names);

  struct Accepted {
    std::string digest;                       // of the body
    std::map<std::size_t, std::string> jobs;  // ids, by index in the request
  };
  // Remembers an accepted request. If the name is known with the same digest, adds the jobs to the
  // known jobs. A request with another digest replaces the known request.
  void remember(const std::string& name, Accepted accepted);
  [[nodiscard]] const Accepted* find(const std::string& name) const;

 private:
  std::size_t kept_max_;
  // by name: callbacks to call when the request has been answered
  std::unordered_map<std::string, std::vector<std::function<void()>>> under_way_;
  std::unordered_map<std::string, Accepted> accepted_;
  std::deque<std::string> in_order_;  // names in accepted_, oldest first
};

}  // namespace armloom
