#include "core/executive/job_request.h"

#include <string>

namespace armloom {

std::vector<JobRequest::PlacedMotion> JobRequest::motions() const {
  if (move_to) return {};
  if (alternatives.empty()) return {{"/trajectory", trajectory}};
  std::vector<PlacedMotion> all;
  for (std::size_t i = 0; i < alternatives.size(); ++i) {
    all.push_back({"/alternatives/" + std::to_string(i), alternatives[i]});
  }
  return all;
}

}  // namespace armloom
