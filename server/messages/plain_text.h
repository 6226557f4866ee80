#pragma once

#include <string>

#include "server/codec/format.h"

namespace armloom {

// Answers of the API as text for people. `answer` is the JSON of the message; `now_s` is the
// present cell time. Every text ends with a newline.

// Says in one paragraph what state the job is in and since when, what it waits for, how it will
// end, and what a client can do.
[[nodiscard]] std::string job_text(const Schema& job, double now_s);
[[nodiscard]] std::string job_page_text(const Schema& page, double now_s);
[[nodiscard]] std::string queue_text(const Schema& queue, double now_s);
[[nodiscard]] std::string arm_text(const Schema& arm, double now_s);
[[nodiscard]] std::string arm_list_text(const Schema& arms, double now_s);
[[nodiscard]] std::string speed_text(const Schema& speed, double now_s);
[[nodiscard]] std::string fault_text(const Schema& fault, double now_s);
[[nodiscard]] std::string fault_list_text(const Schema& faults, double now_s);
[[nodiscard]] std::string stopped_text(const Schema& stopped, double now_s);
[[nodiscard]] std::string problem_text(const Schema& problem);

// Returns one line for an event, or "" for a state frame. `message` is the envelope.
[[nodiscard]] std::string event_text(const Schema& message);

// Returns "4.0 mm apart", or "overlap by 3.0 mm" for a negative clearance.
[[nodiscard]] std::string distance_text(double clearance_m);

}  // namespace armloom
