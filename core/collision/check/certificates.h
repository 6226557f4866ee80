#pragma once

#include <span>

#include "core/collision/diagram/motion_store.h"
#include "core/coordination/certificate.h"
#include "core/coordination/motion.h"

namespace armloom {

// Returns one side of a certificate: the arms of one motion from its present progress on, or one
// arm at rest if `motion` is null. Precondition: `arms` are the entries of these arms; not empty.
[[nodiscard]] CertifiedSide certified_side(std::span<MotionStore::Entry* const> arms,
                                           const Motion* motion);
// Returns the certificate of a pair of sides. Precondition: both sides were compared in this scene,
// and all states outside `blocked` are free.
[[nodiscard]] PairCertificate pair_certificate(const PlanningScene& scene, CertifiedSide a,
                                               CertifiedSide b, std::vector<ProgressBox> blocked);

}  // namespace armloom
