#pragma once

#include <Eigen/Geometry>

#include "core/model/cell_description.h"
#include "server/codec/format.h"
#include "server/codec/object_format.h"

namespace armloom {

// Parts of the cell file's description (cell_format.h) for poses, shapes and objects.

// Members xyz and rpy.
[[nodiscard]] formats::PartPtr<Eigen::Isometry3d> pose_part(
    formats::Need xyz = formats::Need::optional);
// A box, a cylinder or a sphere: exactly one of these members.
[[nodiscard]] formats::PartPtr<Shape> primitive_part();
// An object of the scene: a name, a shape, a pose.
[[nodiscard]] FormatPtr<ObjectDescription> scene_object_format();

}  // namespace armloom
