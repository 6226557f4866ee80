#include "core/coordination/certificate.h"

#include "core/base/content_hash.h"

namespace armloom {

Fingerprint SceneFingerprint::of(const std::vector<ArmId>& which) const {
  ContentHash hash;
  hash.add(common);
  for (const ArmId arm : which) {
    hash.add(arm.index());
    hash.add(arms[arm.index()]);
  }
  return hash.value();
}

}  // namespace armloom
