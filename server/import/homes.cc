#include "server/import/homes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string_view>

namespace armloom {
namespace {

constexpr std::size_t kMadeUp = 300;
constexpr double kMadeUpClearance_m = 0.1;  // room to leave the home

double zero_of(const Joint& joint) { return std::clamp(0.0, joint.lower, joint.upper); }

// Returns the n-th van der Corput number to a base. These numbers are evenly spread over 0..1.
double van_der_corput(std::size_t n, std::size_t base) {
  double number = 0.0;
  double digit = 1.0;
  for (; n > 0; n /= base) {
    digit /= static_cast<double>(base);
    number += digit * static_cast<double>(n % base);
  }
  return number;
}

// Returns the n-th generated configuration: a point of the Halton sequence in a box around zero.
// The box grows with n up to the joint limits. Values are rounded to 0.001 rad (or m) for
// readability.
Eigen::VectorXd made_up(const Cell& cell, const Arm& arm, std::size_t n) {
  static constexpr std::array<std::size_t, 12> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  const double share = static_cast<double>(n) / static_cast<double>(kMadeUp);
  Eigen::VectorXd q(static_cast<Eigen::Index>(arm.joints.size()));
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    const Joint& joint = cell.joint(arm.joints[j]);
    const double zero = zero_of(joint);
    const double lower = std::max(joint.lower, -std::numbers::pi);
    const double upper = std::min(joint.upper, std::numbers::pi);
    const double at = van_der_corput(n + j / kPrimes.size(), kPrimes[j % kPrimes.size()]);
    const double from = zero + share * (lower - zero);
    const double to = zero + share * (upper - zero);
    const double value = std::round(1000.0 * (from + at * (to - from))) / 1000.0;
    q[static_cast<Eigen::Index>(j)] = std::clamp(value, joint.lower, joint.upper);
  }
  return q;
}

}  // namespace

std::size_t home_rank(std::string name) {
  static constexpr std::array<std::string_view, 11> kNames{
      "home", "ready", "rest", "stow", "tuck", "park", "start", "default", "neutral", "up", "zero"};
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto it = std::ranges::find_if(
      kNames, [&](std::string_view word) { return name.find(word) != name.npos; });
  return static_cast<std::size_t>(it - kNames.begin());
}

std::vector<HomeCandidate> home_candidates(const Cell& cell, const Arm& arm) {
  std::vector<HomeCandidate> candidates;
  for (const auto& [name, q] : arm.named_states) {
    candidates.push_back({HomeCandidate::Kind::named, name, q});
  }
  std::ranges::stable_sort(candidates, {},
                           [](const HomeCandidate& one) { return home_rank(one.state); });
  Eigen::VectorXd zero(static_cast<Eigen::Index>(arm.joints.size()));
  for (std::size_t j = 0; j < arm.joints.size(); ++j) {
    zero[static_cast<Eigen::Index>(j)] = zero_of(cell.joint(arm.joints[j]));
  }
  candidates.push_back({HomeCandidate::Kind::zero, {}, zero});
  for (std::size_t n = 1; n <= kMadeUp; ++n) {
    candidates.push_back({HomeCandidate::Kind::made_up, {}, made_up(cell, arm, n)});
  }
  return candidates;
}

Result<Homes> choose_homes(const CellPtr& cell) {
  std::vector<std::vector<HomeCandidate>> candidates;
  HomePlaces places;
  Homes homes;
  for (const Arm& arm : cell->arms) {
    candidates.push_back(home_candidates(*cell, arm));
    homes.wanted.push_back(candidates.back().front());
    auto& of_arm = places.emplace_back();
    for (const HomeCandidate& candidate : candidates.back()) {
      const bool made_up = candidate.kind == HomeCandidate::Kind::made_up;
      of_arm.push_back({candidate.q, std::max(cell->clearances.clearance_m,
                                              made_up ? kMadeUpClearance_m : 0.0)});
    }
  }
  auto found = find_free_homes(cell, places);
  if (!found) return failure(found.error());
  homes.found = *std::move(found);
  homes.of_arm = homes.wanted;
  homes.is_free = homes.found.chosen.has_value();
  for (std::size_t a = 0; a < candidates.size(); ++a) {
    homes.tried.push_back(candidates[a].size());
    if (homes.is_free) homes.of_arm[a] = candidates[a][(*homes.found.chosen)[a]];
  }
  return homes;
}

}  // namespace armloom
