#pragma once

#include <string>
#include <vector>

#include "server/codec/format.h"

namespace armloom {

// An arm that cannot be resumed, because the link to its controller is not up.
struct UnlinkedArm {
  std::string name;
  bool has_connected;  // before
  std::string detail;  // why the link is not up
};
// What a text needs besides the answer.
struct Present {
  double time_s = 0.0;  // cell time
  std::vector<UnlinkedArm> unlinked = {};
  std::vector<std::string> ending = {};  // ids of jobs that end as soon as their arms rest
};

// Answers of the API as text for people, made from the JSON of the message. Every text ends with a
// newline.

// Says in one paragraph what state the job is in and since when, what it waits for, how it will
// end, and what a client can do.
[[nodiscard]] std::string job_text(const Schema& job, const Present& now);
[[nodiscard]] std::string job_page_text(const Schema& page, const Present& now);
[[nodiscard]] std::string queue_text(const Schema& queue, const Present& now);
[[nodiscard]] std::string arm_text(const Schema& arm, const Present& now);
[[nodiscard]] std::string arm_list_text(const Schema& arms, const Present& now);
[[nodiscard]] std::string speed_text(const Schema& speed, const Present& now);
[[nodiscard]] std::string fault_text(const Schema& fault, const Present& now);
[[nodiscard]] std::string fault_list_text(const Schema& faults, const Present& now);
[[nodiscard]] std::string stopped_text(const Schema& stopped, const Present& now);
[[nodiscard]] std::string problem_text(const Schema& problem);

// Returns one line for an event, or "" for a state frame. `message` is the envelope.
[[nodiscard]] std::string event_text(const Schema& message);

// Returns "4.0 mm apart", or "overlap by 3.0 mm" for a negative clearance.
[[nodiscard]] std::string distance_text(double clearance_m);

}  // namespace armloom
