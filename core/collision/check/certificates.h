#pragma once

#include <span>

#include "core/collision/diagram/motion_store.h"
#include "core/coordination/certificate.h"
#include "core/coordination/motion.h"

namespace armloom {

// Returns the arms of one motion from its present progress on, or one arm at rest (`motion` is
// null). Precondition: `arms` are its entries, not empty.
[[nodiscard]] CertifiedSide certified_side(std::span<MotionStore::Entry* const> arms,
                                           const Motion* motion);
// Precondition: both were compared in this scene and are free outside `blocked`.
[[nodiscard]] PairCertificate pair_certificate(const PlanningScene& scene, CertifiedSide a,
                                               CertifiedSide b, std::vector<ProgressBox> blocked);

}  // namespace armloom
