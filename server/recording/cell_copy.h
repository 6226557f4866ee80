#pragma once

#include <filesystem>
#include <string>

#include "core/base/problem.h"

namespace armloom {

// Copies the files that a cell file names, so that a recording stays complete on another machine.
// Robots' files and meshes go to the folder "files"; equal names get numbers ("arm.stl",
// "arm-2.stl"). Mesh names in a copied URDF lead to the copied meshes.

struct CellFile {
  std::filesystem::path file;
  std::string text;
};

// Copies all files that the cell file names into `folder`. Returns the cell file's text with the
// paths of the copies, without comments. Precondition: the cell was built from `source`. Problem
// (unavailable): a file cannot be copied.
[[nodiscard]] Result<std::string> copy_cell(const CellFile& source,
                                            const std::filesystem::path& folder);

}  // namespace armloom
