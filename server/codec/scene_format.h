#pragma once

#include <Eigen/Geometry>

#include "core/model/cell_description.h"
#include "server/codec/format.h"
#include "server/codec/object_format.h"

namespace armloom {

// Parts of the description of the cell file (cell_format.h): poses, shapes and objects.

// Describes a pose by the members xyz and rpy.
[[nodiscard]] formats::PartPtr<Eigen::Isometry3d> pose_part(
    formats::Need xyz = formats::Need::optional);
// Describes a box, a cylinder or a sphere: an object must have exactly one of these members.
[[nodiscard]] formats::PartPtr<Shape> primitive_part();
// Describes `mass_kg` and `center_of_mass_m` of an object.
[[nodiscard]] formats::PartPtr<Mass> mass_part();
// Describes an object of the scene by name, shape, pose and mass.
[[nodiscard]] FormatPtr<ObjectDescription> scene_object_format();

}  // namespace armloom
