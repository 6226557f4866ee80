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

// What WebSocket, SSE and recordings carry. `clock` is null in a simulated run: keys ending in
// `_at`, and `at`, are then absent.

// One envelope {"stream", "seq", "type", "t_s", "at", "data"}.
[[nodiscard]] std::string event_json(const Event& event, const std::string& stream,
                                     const WallClock* clock);

// The envelope that a new subscriber gets first.
struct SnapshotView {
  const Snapshot* snapshot;  // but for its jobs
  const std::vector<ListedJob>* jobs;
  const Cell* cell;
  double speed;
  bool gap;  // events were lost since the subscriber was here last
};
[[nodiscard]] std::string snapshot_json(const SnapshotView& view, const std::string& stream,
                                        const WallClock& clock);

// A pose frame, without stream and seq; positions rounded to 1e-6. `speed`: cell seconds per wall
// second.
[[nodiscard]] std::string state_json(const StateFrame& frame, const Cell& cell, double speed);

// The schema of all of these, as one; the types by which it tells them apart, with their schemas'
// names.
[[nodiscard]] Schema message_schema();
[[nodiscard]] std::vector<std::pair<std::string, std::string>> message_types();

}  // namespace armloom
