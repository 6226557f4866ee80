#pragma once

#include <string>
#include <vector>

#include "core/executive/home_search.h"
#include "core/model/cell.h"

namespace armloom {

// A possible home: a named state, every joint at zero, or a generated configuration.
struct HomeCandidate {
  enum class Kind { named, zero, made_up } kind;
  std::string state;  // name, if named
  Eigen::VectorXd q;
};
// Returns the rank of a state name as a home; smaller is better.
[[nodiscard]] std::size_t home_rank(std::string name);

// Returns an arm's candidates, best first: states with names for homes, other states, zero,
// generated configurations at growing distance from zero. Deterministic.
[[nodiscard]] std::vector<HomeCandidate> home_candidates(const Cell& cell, const Arm& arm);

// A home for each arm, at which all arms keep their clearance except for found.lasting. If none are
// found, `is_free` is false, each arm has its best candidate, and found.frequent names obstacles.
struct Homes {
  std::vector<HomeCandidate> of_arm;
  std::vector<HomeCandidate> wanted;  // the best candidate of each arm
  bool is_free = false;
  HomeChoice found;
  std::vector<std::size_t> tried;  // number of candidates by arm
};
// Problems: those of find_free_homes.
[[nodiscard]] Result<Homes> choose_homes(const CellPtr& cell);

}  // namespace armloom
