#pragma once

#include <vector>

#include "core/base/problem.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// Add the problems that planning_scene.h lists, with pointers "/objects/<index>/..." and
// "/attachments/<index>/...".
void find_link_problems(const Cell& cell, Problems& problems);
void find_object_problems(const std::vector<CollisionObject>& objects,
                          const std::vector<Attachment>& held, Problems& problems);
void find_unknown_allowed(const Cell& cell, Problems& problems);
void find_attachment_problems(const Cell& cell, const std::vector<CollisionObject>& objects,
                              const std::vector<Attachment>& attachments, Problems& problems);

}  // namespace armloom
