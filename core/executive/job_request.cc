#include "core/executive/job_request.h"

#include <string>

namespace armloom {

const char* to_string(JobOrder order) { return order == JobOrder::any ? "any" : "as_given"; }

const char* to_string(OnTimeout what) { return what == OnTimeout::replan ? "replan" : "abort"; }

const char* to_string(Approach how) { return how == Approach::plan ? "plan" : "none"; }

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
