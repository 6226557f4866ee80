#pragma once

#include <string>
#include <vector>

#include "core/executive/home_search.h"
#include "core/model/cell.h"

namespace armloom {

// A place where an arm may begin: a named state of its group, every joint at zero, or one that was
// made up.
struct HomeCandidate {
  enum class Kind { named, zero, made_up } kind;
  std::string state;  // of a named one
  Eigen::VectorXd q;
};
// How much the name of a state speaks of a home; smaller is more.
[[nodiscard]] std::size_t home_rank(std::string name);

// Of one arm, the best first: states whose names speak of home, other states, zero; then
// configurations made up around zero, ever farther away, the same in every call.
[[nodiscard]] std::vector<HomeCandidate> home_candidates(const Cell& cell, const Arm& arm);

// For each arm the candidate with which all stand free; with none, each one's best, and `is_free`
// is false.
struct Homes {
  std::vector<HomeCandidate> of_arm;
  std::vector<HomeCandidate> wanted;  // what would have been taken first
  bool is_free = false;
};
// Problems: as find_free_homes.
[[nodiscard]] Result<Homes> choose_homes(const CellPtr& cell);

}  // namespace armloom
