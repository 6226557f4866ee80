#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace armloom {

// So many are kept (AlertBook says which).
inline constexpr std::size_t kAlertsKept = 1'000;

// What somebody has to see to, until somebody has. Times are of wall time, since 1970.
struct StoredAlert {
  struct Acknowledgement {
    std::string who;
    std::int64_t at_ms = 0;
  };
  std::string id;  // of the event that told it: "<stream>:<seq>"
  std::int64_t at_ms = 0;
  std::string level;  // "warning", "error"
  std::string text;
  std::optional<Acknowledgement> acknowledged = {};
};

}  // namespace armloom
