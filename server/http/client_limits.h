#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>

#include "server/http/message.h"

namespace armloom {

// So many a second on the whole, and so many at once after a time without any.
struct Rate {
  double per_second;
  double burst;
};

// What is left of a rate (a token bucket).
class Allowance {
 public:
  using Time = std::chrono::steady_clock::time_point;
  Allowance(Rate rate, Time now) : rate_(rate), left_(rate.burst), at_(now) {}

  // Until `count` more may be taken; zero: they may be now. More than the burst at once waits for
  // all of it.
  [[nodiscard]] std::chrono::duration<double> wait_for(double count, Time now);
  // Precondition: they may.
  void take(double count) { left_ -= count; }
  [[nodiscard]] bool is_full(Time now) const { return left_at(now) >= rate_.burst; }

 private:
  [[nodiscard]] double left_at(Time now) const;
  Rate rate_;
  double left_;
  Time at_;
};

// How much each client may ask for, and all of them together, so that one that runs wild leaves the
// others their share. A client is whoever shows a token, or else an address. On the server's
// thread.
class ClientLimits {
 public:
  using Time = Allowance::Time;
  struct Options {
    Rate requests{5'000, 10'000};  // of each client
    Rate requests_of_all{20'000, 40'000};
    Rate jobs{1'000, 10'000};  // that are submitted
    Rate jobs_of_all{2'000, 20'000};
  };
  explicit ClientLimits(Options options, Time now = std::chrono::steady_clock::now());

  // One more request; why not (429, with Retry-After).
  [[nodiscard]] std::optional<Refusal> request(const std::string& client, Time now);
  // So many jobs in one request. A batch of more than may come at once is let through where nothing
  // else was taken.
  [[nodiscard]] std::optional<Refusal> jobs(const std::string& client, std::size_t count, Time now);
  // Whose allowances are not whole: no others are remembered.
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
