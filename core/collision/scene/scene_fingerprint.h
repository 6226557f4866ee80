#pragma once

#include <set>
#include <vector>

#include "core/collision/scene/scene_bodies.h"
#include "core/coordination/certificate.h"
#include "core/model/attachment.h"
#include "core/model/cell.h"

namespace armloom {

// Hashes of the content that certificates rely on:
// - poses and shapes (the triangles of meshes)
// - required distances
// - pairs that are not checked

// Returns the hashes of the cell's links, without objects and attached objects. `out_of_reach`:
// pairs that are not checked because they are proven apart.
[[nodiscard]] SceneFingerprint fingerprint_of_links(const Cell& cell,
                                                    const std::set<LinkPair>& out_of_reach);
// Returns the hash of each arm: its hash in `links`, combined with its attached objects.
[[nodiscard]] std::vector<Fingerprint> fingerprint_of_arms(
    const Cell& cell, const SceneFingerprint& links, const std::vector<Attachment>& attachments);
// Returns the hash of an object: CollisionBody::content. `touch`: of this object; may be null.
[[nodiscard]] Fingerprint fingerprint_of_object(const CollisionObject& object,
                                                const AllowedTouch* touch);
// Returns SceneFingerprint::objects. Precondition: `bodies` is complete; pairs and groups may be
// missing.
[[nodiscard]] std::vector<std::vector<Fingerprint>> fingerprint_of_objects(
    const PlanningScene::Bodies& bodies);

}  // namespace armloom
