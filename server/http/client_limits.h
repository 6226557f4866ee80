#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>

#include "server/http/message.h"

namespace armloom {

// A rate limit: the sustained rate, and the burst that is allowed after an idle time.
struct Rate {
  double per_second;
  double burst;
};

// A token bucket.
class Allowance {
 public:
  using Time = std::chrono::steady_clock::time_point;
  Allowance(Rate rate, Time now) : rate_(rate), left_(rate.burst), at_(now) {}

  // Returns the time until `count` tokens are available; zero if they are available now. For a
  // count above the burst, a full bucket is enough.
  [[nodiscard]] std::chrono::duration<double> wait_for(double count, Time now);
  // Precondition: wait_for(count) is zero.
  void take(double count) { left_ -= count; }
  [[nodiscard]] bool is_full(Time now) const { return left_at(now) >= rate_.burst; }

 private:
  [[nodiscard]] double left_at(Time now) const;
  Rate rate_;
  double left_;
  Time at_;
};

// Rate limits for each client and for all clients together, so that a runaway client leaves others
// their share. A client is identified by its access token, or by its address if it has no token.
// Use on the server's thread.
class ClientLimits {
 public:
  using Time = Allowance::Time;
  struct Options {
    Rate requests{5'000, 10'000};  // of each client
    Rate requests_of_all{20'000, 40'000};
    Rate jobs{1'000, 10'000};  // submitted
    Rate jobs_of_all{2'000, 20'000};
  };
  explicit ClientLimits(Options options, Time now = std::chrono::steady_clock::now());

  // Counts one request. Returns a refusal (429, with Retry-After) if it exceeds a limit.
  [[nodiscard]] std::optional<Refusal> request(const std::string& client, Time now);
  // Counts `count` jobs of one request. Returns a refusal like request(). If the buckets are full,
  // even a batch above the burst is admitted.
  [[nodiscard]] std::optional<Refusal> jobs(const std::string& client, std::size_t count, Time now);
  // Returns the number of remembered clients. Clients with full buckets are forgotten.
  [[nodiscard]] std::size_t clients() const { return clients_.size(); }

 private:
  struct Client {
    Allowance requests, jobs;
  };
  [[nodiscard]] Client& client(const std::string& name, Time now);
  void forget_idle(Time now);

  Options options_;
  Allowance all_requests_, all_jobs_;
  std::unordered_map<std::string, Client> clients_;
  Time forgot_at_;
};

}  // namespace armloom
