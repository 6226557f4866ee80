#pragma once

#include <set>
#include <string>

#include "core/base/diagnostics.h"
#include "core/model/cell.h"
#include "core/model/cell_description.h"

namespace armloom {

// Check the parts of a cell file that need no robot files: names, objects and settings. The place
// of a problem is a JSON pointer into the cell file ("/checking/time_step_s").
void check_names(const CellDescription& description, Diagnostics& diagnostics);
void check_objects(const CellDescription& description, Diagnostics& diagnostics);
void check_settings(const CellDescription& description, Diagnostics& diagnostics);
void check_io(const IoDescription& io, Diagnostics& diagnostics);

// Checks a name that is used in API paths, and adds it to `known`. `kind`: "a robot".
void check_name(const std::string& name, const std::string& kind, const std::string& pointer,
                std::set<std::string>& known, Diagnostics& diagnostics);

// Checks that X is finite and rigid up to rounding. `whose` begins the message ("robot left:
// base").
void check_pose(const Eigen::Isometry3d& X, const std::string& pointer, const std::string& whose,
                Diagnostics& diagnostics);

// Adds the pairs of the cell file's allowed_collisions. A pair is two links of any robots, or a
// link and an object. Precondition: every robot's links are in the cell.
void allow_pairs_of_cell(const CellDescription& description, Cell& cell, Diagnostics& diagnostics);

}  // namespace armloom
