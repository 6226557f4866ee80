#pragma once

#include <filesystem>
#include <string>

#include "core/base/problem.h"

namespace armloom {

// What the paths of a cell file lead to, copied: so that a recording may be moved to another
// machine and is still whole. Robots' files and meshes come to the folder "files" beside the copy,
// those of one name beside each other ("arm.stl", "arm-2.stl"); a URDF names its meshes there.

struct CellFile {
  std::filesystem::path file;
  std::string text;
};

// The text of the cell file for `folder`, comments lost. Precondition: the cell was built from it,
// so that all that it names is there. Problem (unavailable): something cannot be copied.
[[nodiscard]] Result<std::string> copy_cell(const CellFile& source,
                                            const std::filesystem::path& folder);

}  // namespace armloom
