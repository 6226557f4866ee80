#include "test/physics/recorded_contacts.h"

#include <algorithm>
#include <stdexcept>

namespace armloom::test {

std::vector<RecordedContact> find_contacts(const CellPtr& cell,
                                           const std::vector<RecordedState>& states) {
  auto oracle = ContactOracle::create(cell);
  if (!oracle) throw std::runtime_error(oracle.error().front().detail);
  std::vector<RecordedContact> found;
  for (const RecordedState& state : states) {
    for (const BodyContact& bodies : oracle->contacts(state.q)) {
      const bool is_known = std::ranges::any_of(found, [&](const RecordedContact& known) {
        return known.bodies.body_a == bodies.body_a && known.bodies.body_b == bodies.body_b;
      });
      if (!is_known) found.push_back({state.time, bodies});
    }
  }
  return found;
}

}  // namespace armloom::test
