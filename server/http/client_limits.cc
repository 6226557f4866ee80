#include "server/http/client_limits.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace armloom {
namespace {

constexpr std::chrono::seconds kForgetEvery{10};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

Refusal too_many(const char* what, const char* whose, Rate rate,
                 std::chrono::duration<double> wait) {
  const auto seconds = static_cast<long>(std::ceil(std::max(wait.count(), 0.001)));
  return {429,
          "too-many-requests",
          std::string(whose) + " may send " + number(rate.per_second) + " " + what + " a second, " +
              number(rate.burst) + " at once",
          std::nullopt,
          std::nullopt,
          {{"Retry-After", std::to_string(seconds)}}};
}

constexpr const char* kOne = "one client";
constexpr const char* kAll = "all clients together";

}  // namespace

double Allowance::left_at(Time now) const {
  const std::chrono::duration<double> passed = std::max(now, at_) - at_;
  return std::min(rate_.burst, left_ + passed.count() * rate_.per_second);
}

std::chrono::duration<double> Allowance::wait_for(double count, Time now) {
  left_ = left_at(now);
  at_ = std::max(now, at_);
  const double missing = std::min(count, rate_.burst) - left_;
  return std::chrono::duration<double>(missing > 0.0 ? missing / rate_.per_second : 0.0);
}

ClientLimits::ClientLimits(Options options, Time now)
    : options_(options),
      all_requests_(options.requests_of_all, now),
      all_jobs_(options.jobs_of_all, now),
      forgot_at_(now) {}

ClientLimits::Client& ClientLimits::client(const std::string& name, Time now) {
  forget_idle(now);
  const auto made = Client{{options_.requests, now}, {options_.jobs, now}};
  return clients_.try_emplace(name, made).first->second;
}

// Forgets clients whose buckets are full: they are equivalent to new clients.
void ClientLimits::forget_idle(Time now) {
  if (now - forgot_at_ < kForgetEvery) return;
  forgot_at_ = now;
  std::erase_if(clients_, [now](const auto& known) {
    return known.second.requests.is_full(now) && known.second.jobs.is_full(now);
  });
}

std::optional<Refusal> ClientLimits::request(const std::string& name, Time now) {
  Client& one = client(name, now);
  if (const auto wait = one.requests.wait_for(1, now); wait.count() > 0) {
    return too_many("requests", kOne, options_.requests, wait);
  }
  if (const auto wait = all_requests_.wait_for(1, now); wait.count() > 0) {
    return too_many("requests", kAll, options_.requests_of_all, wait);
  }
  one.requests.take(1);
  all_requests_.take(1);
  return std::nullopt;
}

std::optional<Refusal> ClientLimits::jobs(const std::string& name, std::size_t count, Time now) {
  Client& one = client(name, now);
  const auto asked = static_cast<double>(count);
  if (const auto wait = one.jobs.wait_for(asked, now); wait.count() > 0) {
    return too_many("jobs", kOne, options_.jobs, wait);
  }
  if (const auto wait = all_jobs_.wait_for(asked, now); wait.count() > 0) {
    return too_many("jobs", kAll, options_.jobs_of_all, wait);
  }
  one.jobs.take(asked);
  all_jobs_.take(asked);
  return std::nullopt;
}

}  // namespace armloom
