#include "core/audit/touch_rules.h"

#include <algorithm>

namespace armloom {

TouchRules::TouchRules(const Cell& cell, const RecordedScene& scene) : cell_(cell) {
  for (const Attachment& held : scene.held) {
    Held& of =
        held_.try_emplace(held.object.name, Held{&held, hand_of(cell, held.link)}).first->second;
    for (const Attachment::Other& other : held.others) {
      const std::vector<bool> hand = hand_of(cell, other.link);
      for (std::size_t link = 0; link < hand.size(); ++link) {
        of.hand[link] = of.hand[link] || hand[link];
      }
    }
  }
  for (const AllowedTouch& touch : scene.touch) touch_.try_emplace(touch.object, &touch.links);
}

bool TouchRules::may_touch(const AuditedSolid& a, const AuditedSolid& b) const {
  if (a.is_held()) return held_may_touch(a, b);
  if (b.is_held()) return held_may_touch(b, a);
  // Pairs that an SRDF only claims (claimed_pairs) are checked.
  if (b.link) return cell_.allowed.allows(*a.link, *b.link);
  if (cell_.allowed.link_objects.contains({*a.link, b.name})) return true;
  const auto touch = touch_.find(b.name);
  return touch != touch_.end() && std::ranges::count(*touch->second, *a.link) > 0;
}

bool TouchRules::held_may_touch(const AuditedSolid& held, const AuditedSolid& other) const {
  const auto& [attachment, hand] = held_.at(held.name);
  if (!other.carrier) return std::ranges::count(attachment->touch_objects, other.name) > 0;
  if (hand[other.carrier->index()]) return true;
  if (other.is_held()) return false;
  return std::ranges::count(attachment->touch, *other.link) > 0 ||
         cell_.allowed.link_objects.contains({*other.link, held.name});
}

}  // namespace armloom
