#pragma once

#include "core/base/diagnostics.h"
#include "core/model/cell.h"
#include "core/model/cell_description.h"

namespace armloom {

// The parts of a cell file that stand on their own: names, poses, objects' shapes and settings.
// Places are JSON pointers with the keys of the file ("/checking/time_step_s").
void check_names(const CellDescription& description, Diagnostics& diagnostics);
void check_objects(const CellDescription& description, Diagnostics& diagnostics);
void check_settings(const CellDescription& description, Diagnostics& diagnostics);

// Finite, and a rotation up to rounding; `whose` begins the sentence: "robot left: base".
void check_pose(const Eigen::Isometry3d& X, const std::string& pointer, const std::string& whose,
                Diagnostics& diagnostics);

// Adds the cell file's allowed_collisions: link with link of any robot, or link with object.
// Precondition: every robot's links are in the cell.
void allow_pairs_of_cell(const CellDescription& description, Cell& cell, Diagnostics& diagnostics);

}  // namespace armloom
