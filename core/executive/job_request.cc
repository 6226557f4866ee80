#include "core/executive/job_request.h"

#include <string>

namespace armloom {

std::vector<JobRequest::PlacedMotion> JobRequest::motions() const {
  if (move_to || !steps.empty()) return {};
  if (alternatives.empty()) return {{trajectory.place.value_or("/trajectory"), trajectory}};
  std::vector<PlacedMotion> all;
  for (std::size_t i = 0; i < alternatives.size(); ++i) {
    const auto& place = alternatives[i].place;
    all.push_back({place.value_or("/alternatives/" + std::to_string(i)), alternatives[i]});
  }
  return all;
}

}  // namespace armloom
