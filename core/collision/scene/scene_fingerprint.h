#pragma once

#include <set>
#include <vector>

#include "core/collision/scene/scene_bodies.h"
#include "core/coordination/certificate.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// The content that certificates rely on, as hashes: poses and shapes (the triangles of meshes), the
// distances that are kept, and the pairs that are not looked at.

// Returns the cell's links without objects; the arms hold nothing. `out_of_reach`: pairs that are
// not looked at because the checker has proven them apart.
[[nodiscard]] SceneFingerprint fingerprint_of_links(const Cell& cell,
                                                    const std::set<LinkPair>& out_of_reach);
// Returns `links` with what arms hold.
[[nodiscard]] std::vector<Fingerprint> fingerprint_of_arms(
    const Cell& cell, const SceneFingerprint& links, const std::vector<Attachment>& attachments);
// Returns SceneFingerprint::objects. Precondition: `bodies` is complete but for pairs and groups.
[[nodiscard]] std::vector<std::vector<Fingerprint>> fingerprint_of_objects(
    const PlanningScene::Bodies& bodies);

}  // namespace armloom
