#pragma once

#include "core/base/diagnostics.h"
#include "core/model/cell.h"
#include "core/model/cell_description.h"

namespace armloom {

// Check the parts of a cell file that need no robot files: names, objects and settings. Places are
// JSON pointers with the keys of the file ("/checking/time_step_s").
void check_names(const CellDescription& description, Diagnostics& diagnostics);
void check_objects(const CellDescription& description, Diagnostics& diagnostics);
void check_settings(const CellDescription& description, Diagnostics& diagnostics);

// Checks that X is finite and rigid up to rounding. `whose` begins the sentence: "robot left:
// base".
void check_pose(const Eigen::Isometry3d& X, const std::string& pointer, const std::string& whose,
                Diagnostics& diagnostics);

// Adds the cell file's allowed_collisions: pairs of links of any robots, or of a link and an
// object. Precondition: every robot's links are in the cell.
void allow_pairs_of_cell(const CellDescription& description, Cell& cell, Diagnostics& diagnostics);

}  // namespace armloom
