#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace armloom {

// Number of alerts that are kept (AlertBook decides which).
inline constexpr std::size_t kAlertsKept = 1'000;

// An alert, open or acknowledged by an operator. Times are wall times since 1970.
struct StoredAlert {
  struct Acknowledgement {
    std::string who;
    std::int64_t at_ms = 0;
  };
  std::string id;  // of its event: "<stream>:<seq>"
  std::int64_t at_ms = 0;
  std::string level;  // "warning", "error"
  std::string text;
  std::optional<Acknowledgement> acknowledged = {};
};

}  // namespace armloom
