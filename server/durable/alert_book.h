#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/executive/events.h"
#include "server/codec/wall_clock.h"
#include "server/durable/job_keeper.h"
#include "server/store/stored_alert.h"

namespace armloom {

// Returns the alert that the event is or reports; nullopt if it is none. A finding of the monitor
// that stops an arm is an error.
[[nodiscard]] std::optional<Alert> alert_of(const Event& event);

// The last kAlertsKept warnings and errors. Acknowledged alerts are dropped first, errors last. A
// keeper stores them on disk. Use on the server's thread.
class AlertBook {
 public:
  // If `keeper` is null, the alerts are lost when the server ends. `keeper` and `clock` must
  // outlive the AlertBook.
  AlertBook(std::string stream, const WallClock& clock, JobKeeper* keeper);

  void happened(const Event& event);
  [[nodiscard]] const std::deque<StoredAlert>& alerts() const { return alerts_; }  // oldest first
  [[nodiscard]] const StoredAlert* find(const std::string& id) const;

  // Records that `who` acknowledged the alerts; an earlier acknowledgement stays. Calls `then` with
  // nullopt when this is on disk, or with the reason why it is not on disk yet. Precondition:
  // find() knows all ids.
  void acknowledge(const std::vector<std::string>& ids, const std::string& who,
                   std::function<void(std::optional<Refusal>)> then);

 private:
  [[nodiscard]] std::deque<StoredAlert>::const_iterator least_needed() const;
  std::string stream_;
  const WallClock& clock_;
  JobKeeper* keeper_;
  std::deque<StoredAlert> alerts_;
};

}  // namespace armloom
