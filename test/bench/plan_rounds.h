#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/trajectory/validate.h"

namespace armloom {

// Records which poses are connected, and which pairs of poses very likely cannot be connected.
class PoseGroups {
 public:
  explicit PoseGroups(std::size_t poses);
  void join(std::size_t a, std::size_t b);
  // Records that even a ten times larger budget found no path.
  void part(std::size_t a, std::size_t b) { parted_.emplace_back(a, b); }
  [[nodiscard]] bool are_joined(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool are_parted(std::size_t a, std::size_t b) const;

 private:
  [[nodiscard]] std::size_t root(std::size_t pose) const;
  std::vector<std::size_t> above_;
  std::vector<std::pair<std::size_t, std::size_t>> parted_;
};

// Joins the solved queries of one arm to a closed tour from the first pose, with each query once
// (Hierholzer's algorithm).
class PlanRounds {
 public:
  void add(std::size_t from, std::size_t to, TrajectoryRequest way);
  // Returns the tour. It contains all queries if each pose has as many outgoing as incoming paths,
  // for example if all queries are solved.
  [[nodiscard]] std::vector<const TrajectoryRequest*> round_from(std::size_t first) const;

 private:
  std::map<std::size_t, std::map<std::size_t, TrajectoryRequest>> ways_;
};

// A jobs file for `armloom simulate`: arms make their tours one after the other.
void write_jobs(const std::string& file,
                const std::vector<std::vector<const TrajectoryRequest*>>& rounds);

}  // namespace armloom
