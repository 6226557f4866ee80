#include "core/executive/validated.h"

namespace armloom {

void validate_ahead(JobRequest& request, const Cell& cell) {
  if (request.move_to) return;
  request.validated.clear();
  for (const auto& [place, motion] : request.motions()) {
    request.validated.push_back(validate(motion, cell));
  }
}

}  // namespace armloom
