#include "core/coordination/certificate.h"

#include <algorithm>

#include "core/base/content_hash.h"

namespace armloom {

Fingerprint SceneFingerprint::of(std::span<const ArmId> one, std::span<const ArmId> other) const {
  ContentHash hash;
  hash.add(common);
  for (auto a = one.begin(), b = other.begin(); a != one.end() || b != other.end();) {
    const bool from_one = b == other.end() || (a != one.end() && *a < *b);
    const ArmId arm = from_one ? *a++ : *b++;
    hash.add(arm.index());
    hash.add(arms[arm.index()]);
  }
  return hash.value();
}

std::vector<ArmId> arms_in_question(const SceneFingerprint& before, const SceneFingerprint& now) {
  // A changed arm invalidates its pairs with every other arm.
  const bool all = before.common != now.common || before.arms != now.arms;
  std::vector<ArmId> arms;
  for (std::uint32_t a = 0; a < now.arms.size(); ++a) {
    const bool stands = std::ranges::includes(before.objects[a], now.objects[a]);
    if (all || !stands) arms.emplace_back(a);
  }
  return arms;
}

double CertifiedSide::error_of(ArmId arm) const {
  const auto at = std::ranges::find(arms, arm);
  return at == arms.end() ? 0.0 : errors[static_cast<std::size_t>(at - arms.begin())];
}

PairCertificate turned(const PairCertificate& pair) {
  PairCertificate result{pair.b, pair.a, {}, pair.geometry};
  for (const ProgressBox& box : pair.blocked) {
    result.blocked.push_back({box.from_b, box.to_b, box.from_a, box.to_a});
  }
  return result;
}

}  // namespace armloom
