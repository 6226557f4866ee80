#include "core/executive/validated.h"

#include <algorithm>

#include "core/trajectory/implicit_start.h"

namespace armloom {

void validate_ahead(JobRequest& request, const Cell& cell) {
  if (request.move_to || !request.steps.empty()) return;
  request.known.validated.clear();
  const auto motions = request.motions();
  // Implicit starts are completed on the strand, which knows where the arms will be.
  if (std::ranges::any_of(motions, [&](const JobRequest::PlacedMotion& placed) {
        return has_implicit_start(placed.motion, cell);
      })) {
    return;
  }
  for (const auto& [place, motion] : motions) {
    request.known.validated.push_back(validate(motion, cell));
  }
}

}  // namespace armloom
