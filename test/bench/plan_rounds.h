#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/trajectory/validate.h"

namespace armloom {

// Which poses have ways between them, and which are very likely in a part of the arm's space that
// no way leads to: then a query between the two has no answer to be found.
class PoseGroups {
 public:
  // Numbered from zero.
  explicit PoseGroups(std::size_t poses);
  void join(std::size_t a, std::size_t b);
  // Between these two nothing was found with a budget ten times as large, either.
  void part(std::size_t a, std::size_t b) { parted_.emplace_back(a, b); }
  [[nodiscard]] bool are_joined(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool are_parted(std::size_t a, std::size_t b) const;

 private:
  [[nodiscard]] std::size_t root(std::size_t pose) const;
  std::vector<std::size_t> above_;
  std::vector<std::pair<std::size_t, std::size_t>> parted_;
};

// Solved queries of one arm, to be run one after the other: from the first pose, at which it
// stands, through each of them once, as far as there is such a round (Hierholzer), and back.
class PlanRounds {
 public:
  void add(std::size_t from, std::size_t to, TrajectoryRequest way);
  // Nothing is left out where from each pose as many ways lead away as come in, as they do where
  // all are solved.
  [[nodiscard]] std::vector<const TrajectoryRequest*> round_from(std::size_t first) const;

 private:
  std::map<std::size_t, std::map<std::size_t, TrajectoryRequest>> ways_;
};

// A jobs file of `armloom simulate`: each arm makes its round when the one before it has.
void write_jobs(const std::string& file,
                const std::vector<std::vector<const TrajectoryRequest*>>& rounds);

}  // namespace armloom
