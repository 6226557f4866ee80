#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/executive/events.h"
#include "core/model/cell.h"
#include "server/codec/format.h"
#include "server/codec/wall_clock.h"
#include "server/messages/job.h"

namespace armloom {

// Messages on WebSocket and SSE and in recordings. `clock` is null in a simulated session; the
// member `at` and keys ending in `_at` are then absent.

// Returns {"stream", "seq", "type", "t_s", "at", "data"}.
[[nodiscard]] std::string event_json(const Event& event, const std::string& stream,
                                     const WallClock* clock);

// Content of the first message to a new subscriber.
struct SnapshotView {
  const Snapshot* snapshot;  // except its jobs, which are in `jobs`
  const std::vector<ListedJob>* jobs;
  const Cell* cell;
  double speed;
  bool gap;  // events since the subscriber's last connection were lost
};
[[nodiscard]] std::string snapshot_json(const SnapshotView& view, const std::string& stream,
                                        const WallClock& clock);

// Positions are rounded to 1e-6. `speed`: cell seconds per wall second.
[[nodiscard]] std::string state_json(const StateFrame& frame, const Cell& cell, double speed);

// Return the schema of all messages, and each message type with the name of its schema.
[[nodiscard]] Schema message_schema();
[[nodiscard]] std::vector<std::pair<std::string, std::string>> message_types();

}  // namespace armloom
