#include "core/collision/check/certificates.h"

#include <algorithm>
#include <utility>

namespace armloom {

CertifiedSide certified_side(std::span<MotionStore::Entry* const> arms, const Motion* motion) {
  CertifiedSide side;
  if (motion != nullptr) {
    side.motion = motion->trajectory;
    side.from = std::clamp(motion->progress, Duration{}, motion->trajectory->duration());
  }
  std::vector<MotionStore::Entry*> ascending(arms.begin(), arms.end());
  std::ranges::sort(ascending, {}, &MotionStore::Entry::arm);
  for (const MotionStore::Entry* entry : ascending) {
    side.arms.push_back(entry->arm);
    side.errors.push_back(entry->tracking_error);
    const auto& joints = entry->tube->kinematics().joints();
    for (std::size_t row = 0; row < joints.size(); ++row) {
      const bool moves = side.motion && std::ranges::find(side.motion->joints(), joints[row]) !=
                                            side.motion->joints().end();
      if (!moves) side.still.emplace_back(joints[row], entry->rest[row]);
    }
  }
  return side;
}

PairCertificate pair_certificate(const PlanningScene& scene, CertifiedSide a, CertifiedSide b,
                                 std::vector<ProgressBox> blocked) {
  const Fingerprint content = scene.fingerprint().of(a.arms, b.arms);
  return {std::move(a), std::move(b), std::move(blocked), content};
}

}  // namespace armloom
