#include "core/executive/validated.h"

namespace armloom {

void validate_ahead(JobRequest& request, const Cell& cell) {
  if (request.move_to) return;
  request.known.validated.clear();
  for (const auto& [place, motion] : request.motions()) {
    request.known.validated.push_back(validate(motion, cell));
  }
}

}  // namespace armloom
