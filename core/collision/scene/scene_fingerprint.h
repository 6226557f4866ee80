#pragma once

#include <set>
#include <vector>

#include "core/collision/scene/scene_bodies.h"
#include "core/coordination/certificate.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// Hashes of the content that certificates rely on: poses and shapes (triangles of meshes), required
// distances, and pairs that are not checked.

// Returns the cell's links, without objects and attached objects. `out_of_reach`: pairs that are
// not checked because they are proven apart.
[[nodiscard]] SceneFingerprint fingerprint_of_links(const Cell& cell,
                                                    const std::set<LinkPair>& out_of_reach);
// Returns `links` with attached objects.
[[nodiscard]] std::vector<Fingerprint> fingerprint_of_arms(
    const Cell& cell, const SceneFingerprint& links, const std::vector<Attachment>& attachments);
// Returns SceneFingerprint::objects. Precondition: `bodies` is complete except pairs and groups.
[[nodiscard]] std::vector<std::vector<Fingerprint>> fingerprint_of_objects(
    const PlanningScene::Bodies& bodies);

}  // namespace armloom
